"""teleop_twist_keyboard: keys of a text in a run, keys of a terminal in a process of its own."""

import os
import pty
import subprocess
import sys
import time

import pytest

from sim import Process, executable, run
from tests.patience import PATIENCE
from tests.sim.standalone.programs import environment, free_domain

LISTENER = """
import rclpy
from geometry_msgs.msg import Twist
rclpy.init()
node = rclpy.create_node("listener")
show = lambda msg: print(f"{msg.linear.x:.3g} {msg.angular.z:.3g}", flush=True)
node.create_subscription(Twist, "/robot1/cmd_vel", show, 10)
rclpy.spin(node)
"""


def driven(*lines, **settings):
    """A run in which these keys are pressed."""
    program = executable("teleop_twist_keyboard", "teleop_twist_keyboard")
    return run(Process(program, stdin=lines, **settings), world="yard", seconds=6)


def commands(recording, topic="/cmd_vel"):
    return [(row.stamp, row.message.linear.x, row.message.angular.z) for row in recording.messages(topic)]


def test_each_key_of_a_text_is_pressed_half_a_second_after_the_one_before_it():
    recording = driven("io", "k")
    assert commands(recording) == [(0.0, 0.5, 0.0), (0.5, 0.5, -1.0), (1.0, 0.0, 0.0), (1.5, 0.0, 0.0)]
    assert recording.path[-1].x > recording.path[0].x + 0.2
    assert recording.errors == []  # and it has ended


def test_speeds_change_by_a_tenth_and_hold_for_the_keys_that_follow():
    assert commands(driven("iqxej"))[1:5] == [
        (0.5, 0.55, 0.0),
        (1.0, pytest.approx(0.495), 0.0),
        (1.5, pytest.approx(0.495), 0.0),
        (2.0, 0.0, pytest.approx(1.21)),
    ]


@pytest.mark.parametrize(
    ("key", "moves"), [("U", (0.5, 0.5, 0.0)), ("b", (0.0, 0.0, -0.5)), ("?", (0.0, 0.0, 0.0))]
)
def test_shift_drives_sideways_t_and_b_up_and_down_and_any_other_key_stops(key, moves):
    first = driven(key).messages("/cmd_vel")[0].message.linear
    assert (first.x, first.y, first.z) == moves


def test_the_topic_is_remapped_and_the_type_is_a_parameter():
    remappings, parameters = [("cmd_vel", "/robot1/cmd_vel")], {"stamped": True, "frame_id": "base"}
    [first, _] = driven("i", remappings=remappings, parameters=parameters).messages("/robot1/cmd_vel")
    assert (first.message.header.frame_id, first.message.twist.linear.x) == ("base", 0.5)


def test_a_frame_needs_a_stamp():
    [error] = driven("i", parameters={"frame_id": "base"}).errors
    assert error.text == "'frame_id' can only be set when 'stamped' is True"


def test_in_a_terminal_it_reads_keys_without_enter_until_ctrl_c():
    words = ["--ros-args", "--remap", "cmd_vel:=/robot1/cmd_vel"]
    domain = free_domain()
    there = environment(ROS_DOMAIN_ID=str(domain), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
    keyboard, terminal = pty.openpty()
    listener = subprocess.Popen([sys.executable, "-c", LISTENER], env=there, stdout=subprocess.PIPE,
                                text=True)  # fmt: skip
    module = "teleop_twist_keyboard.teleop_twist_keyboard"
    teleop = subprocess.Popen([sys.executable, "-m", module, *words], env=there, stdin=terminal,
                              stdout=subprocess.DEVNULL)  # fmt: skip
    try:
        os.set_blocking(listener.stdout.fileno(), False)
        end, received = time.monotonic() + PATIENCE, ""
        while not received and time.monotonic() < end:  # until the two have discovered each other
            os.write(keyboard, b"i")
            time.sleep(0.2)
            received = listener.stdout.readline()
        os.set_blocking(listener.stdout.fileno(), True)
        os.write(keyboard, b"qk\x03")
        assert teleop.wait(PATIENCE) == 0
        lines = [received.strip()]
        while lines[-1] != "0 0":
            lines.append(listener.stdout.readline().strip())
        assert [line for line in lines if line != "0.5 0"] == ["0.55 0", "0 0"]
    finally:
        for process in (teleop, listener):
            process.kill()
            process.wait()
