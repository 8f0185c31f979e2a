"""ROS in the sandbox: works as outside, and stays inside."""
from collections.abc import Iterator

import pytest

from grader.marking.pool import PRELOAD
from grader.marking.sandbox import Sandbox
from tests.marking.sandbox.commanded import sandbox

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
    with sandbox(preload=PRELOAD) as box:
        yield box


def test_a_run_gives_the_same_recording_as_outside(warm, make_commanded):
    code = TALKER + "answer = run(Talker, world='room', seconds=5, seed=3, quiet=True).digest"
    outside: dict = {}
    exec(code, outside)
    assert make_commanded(warm).ask(code) == outside["answer"]


def test_ros_can_be_started_and_ended_beside_a_run(warm, make_commanded):
    code = TALKER + "rclpy.init(); Talker().destroy_node(); rclpy.shutdown(); answer = rclpy.ok()"
    assert make_commanded(warm).ask(code + "\n" + code) is False


def test_nodes_of_two_processes_never_meet_whatever_they_set(warm, make_commanded):
    listen = TALKER + (
        "import os\n"
        "os.environ |= {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET', 'FASTDDS_BUILTIN_TRANSPORTS': 'DEFAULT'}\n"
        "rclpy.init(); node = Talker(); received = []\n"
        "node.create_subscription(String, '/chatter', received.append, 10)\n"
    )
    look = (
        "while len(received) < 10: rclpy.spin_once(node, timeout_sec=0.1)\n"
        "answer = node.count_publishers('/chatter')"
    )
    both = [make_commanded(warm), make_commanded(warm)]
    assert [commanded.ask(listen) for commanded in both] == [None, None]
    for commanded in both:
        commanded.tell(look)
    assert [commanded.answer() for commanded in both] == [1, 1]


def test_it_shares_no_memory_that_it_can_write_with_what_it_was_forked_from(warm, make_commanded):
    maps = make_commanded(warm).ask("answer = open('/proc/self/maps').read().splitlines()")
    rights = {line.split()[1] for line in maps}
    assert "rw-p" in rights
    assert [found for found in rights if "w" in found and "s" in found] == []


def test_what_it_changes_in_memory_is_not_there_for_the_next(warm, make_commanded):
    change = """
import ctypes, os, signal, sys, sim, grader.exercise
sim.run = grader.exercise.Exercise.grade = None
sys.path.insert(0, '/tmp'); os.environ['HOME'] = '/tmp'; os.umask(0); os.chdir('/tmp')
signal.signal(signal.SIGTERM, signal.SIG_IGN)
ctypes.memset(id(sys.copyright) + 64, 65, 8)
answer = 'AAAAAAAA' in sys.copyright
"""
    look = """
import os, signal, sys, sim, grader.exercise
answer = [callable(sim.run), callable(grader.exercise.Exercise.grade), '/tmp' in sys.path, os.environ['HOME'],
          os.umask(0o77), os.getcwd(), signal.getsignal(signal.SIGTERM), 'AAAAAAAA' in sys.copyright]
"""
    first, second = make_commanded(warm), make_commanded(warm)
    assert first.ask(change) is True
    clean = [True, True, False, "/student", 0o77, "/student", 0, False]
    assert second.ask(look) == make_commanded(warm).ask(look) == clean
