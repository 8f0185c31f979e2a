"""What rclpy says in its own words is not shown where `tell` says it in better ones; the recording has it."""

import subprocess
import sys

import pytest
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String

from sim import run


class Sender(Node):
    def __init__(self):
        super().__init__("sender")
        self.create_publisher(String, "words", qos_profile_sensor_data)


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.create_subscription(String, "words", print, 10)
        self.get_logger().warning("mine")


def test_qos_that_does_not_fit_is_recorded_and_not_shown(capfd):
    recording = run(Sender, Listener, seconds=1.0)
    assert sum("incompatible QoS" in line.text for line in recording.logs) == 2
    shown = capfd.readouterr().out
    assert "mine" in shown and "incompatible" not in shown


@pytest.mark.parametrize("name", ["my node", "my-node"])
def test_a_name_that_is_none_gives_its_error_and_no_warning(name):
    code = f"""
from rclpy.node import Node
from sim import run
class Mine(Node):
    def __init__(self):
        super().__init__({name!r})
print(run(Mine, seconds=1.0).errors[0].type)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "InvalidNodeNameException\n"
    assert "rosout" not in done.stderr
