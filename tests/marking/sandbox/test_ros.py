"""ROS in the cage: works as outside, and stays inside."""
from collections.abc import Iterator

import pytest

from grader.marking.sandbox import Sandbox
from tests.marking.sandbox.prison import sandbox

TALKER = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from sim import run

class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(String(data="hello")))
"""


@pytest.fixture(scope="module")
def warm() -> Iterator[Sandbox]:
    with sandbox(preload=("sim",)) as box:
        yield box


def test_a_run_gives_the_same_recording_as_outside(warm, prisoners):
    code = TALKER + "answer = run(Talker, world='room', seconds=5, seed=3, quiet=True).digest"
    outside: dict = {}
    exec(code, outside)
    assert prisoners(warm).ask(code) == outside["answer"]


def test_ros_can_be_started_and_ended_beside_a_run(warm, prisoners):
    code = TALKER + "rclpy.init(); Talker().destroy_node(); rclpy.shutdown(); answer = rclpy.ok()"
    assert prisoners(warm).ask(code + "\n" + code) is False


def test_nodes_of_two_inmates_never_meet_whatever_they_set(warm, prisoners):
    listen = TALKER + (
        "import os\n"
        "os.environ |= {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET', 'FASTDDS_BUILTIN_TRANSPORTS': 'DEFAULT'}\n"
        "rclpy.init(); node = Talker(); heard = []\n"
        "node.create_subscription(String, '/chatter', heard.append, 10)\n"
    )
    look = (
        "for _ in range(20): rclpy.spin_once(node, timeout_sec=0.1)\n"
        "answer = [len(heard) > 0, node.count_publishers('/chatter')]"
    )
    both = [prisoners(warm), prisoners(warm)]
    assert [prisoner.ask(listen) for prisoner in both] == [None, None]
    for prisoner in both:
        prisoner.tell(look)
    assert [prisoner.answer() for prisoner in both] == [[True, 1], [True, 1]]
