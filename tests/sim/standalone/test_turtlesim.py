"""python -m sim --world turtlesim: the programs of the tutorials beside it, each a process of its own."""

import json
import os
import re
import signal
import subprocess
import sys

import pytest

from sim.ros.realtime import ArgumentsError, own_words
from tests.patience import PATIENCE
from tests.sim.ros.test_turtle_launch import MIMIC, file
from tests.sim.ros2.test_terminal import ROS2, start
from tests.sim.standalone.programs import REPOSITORY, ended, environment, free_domain, robot

OFFER = """\
World 'turtlesim' in real time, ROS domain {domain}, this machine only.
  takes /turtle1/cmd_vel  [geometry_msgs/msg/Twist]
  gives /turtle1/color_sensor  [turtlesim/msg/Color]
  gives /turtle1/pose  [turtlesim/msg/Pose]
"""


@pytest.fixture
def pond():
    with robot("--world", "turtlesim", "--headless") as running:
        yield running


def program(pond, name, *arguments):
    """Start a function of the tutorials' programs."""
    domain = {"ROS_DOMAIN_ID": str(pond.domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    code = f"from tests.students.engine import turtles; turtles.{name}()"
    return subprocess.Popen(
        [sys.executable, "-c", code, *arguments],
        cwd=REPOSITORY, env=environment(**domain), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


@pytest.mark.soak
@pytest.mark.parametrize(
    "follower",
    [["follower"], ["late_follower", "--ros-args", "-p", "margin:=0.3"]],  # with more it would swing
)
def test_a_follower_finds_the_turtle_through_tf2_also_where_it_was_5_s_ago(pond, follower):
    assert pond.offer.startswith(OFFER.format(domain=pond.domain))
    tell = [
        program(pond, "broadcaster", "--ros-args", "-r", f"__node:=tell{n}", "-p", f"turtlename:=turtle{n}")
        for n in (1, 2)
    ]
    programs = [*tell, program(pond, *follower)]
    try:
        meeting = json.loads(program(pond, "meeting").communicate(timeout=PATIENCE)[0])
    finally:
        for one in programs:
            one.terminate()
            one.communicate(timeout=PATIENCE)
    assert meeting["turtle1"] == pytest.approx([5.544444561004639] * 2)
    assert meeting["apart"] < 0.1


WATCHER = """
import rclpy
from rclpy.node import Node
from turtlesim.msg import Pose

rclpy.init()
node, received = Node("watcher"), []
node.create_subscription(Pose, "/turtlesim2/turtle1/pose", received.append, 1)
while not received or received[-1].linear_velocity < 1.9:
    rclpy.spin_once(node)
print("it mimics", flush=True)
"""
AROUND = """
        ExecuteProcess(cmd=["python3", f"{HERE}/driver.py", "--ros-args", "-r", "__ns:=/turtlesim1"]),
        ExecuteProcess(
            cmd=["python3", f"{HERE}/watcher.py"], output="screen", on_exit=[EmitEvent(event=Shutdown())]
        ),
"""


@pytest.mark.soak
def test_the_tutorials_launch_file_brings_two_ponds_with_pages_and_a_mimic(tmp_path):
    (tmp_path / "watcher.py").write_text(WATCHER)
    path = file(tmp_path, "mimic.launch.py", MIMIC + AROUND)
    reported = {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "both"}
    reported["PYTHONPATH"] = os.pathsep.join([str(REPOSITORY), str(REPOSITORY / "ros_packages/python")])
    arguments = [*ROS2, "launch", str(path), f"sigterm_timeout:={PATIENCE}"]
    process = start(arguments, free_domain(), ROS_LOG_DIR=str(tmp_path / "log"), **reported)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == (0, "")
    assert "[python3-5] it mimics\n" in out
    assert len(set(re.findall(r"See and drive it at http://localhost:(\d+)", out))) == 2
    assert sorted(re.findall(r"takes (/\S+cmd_vel)", out)) == [
        "/turtlesim1/turtle1/cmd_vel",
        "/turtlesim2/turtle1/cmd_vel",
    ]
    assert out.count("process has finished cleanly") == 4


@pytest.mark.soak
def test_turtlesims_own_launch_file_brings_two_ponds_with_pages(tmp_path):
    arguments = [*ROS2, "launch", "-a", "turtlesim", "multisim.launch.py", f"sigterm_timeout:={PATIENCE}"]
    process = start(arguments, free_domain(), ROS_LOG_DIR=str(tmp_path))
    lines = []
    while len([line for line in lines if "See and drive it at" in line]) < 2:
        lines.append(process.stdout.readline())
        assert lines[-1], process.communicate()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, err) == (0, "")
    assert out.count("process has finished cleanly") == 2
    assert sorted(re.findall(r"takes (/\S+cmd_vel)", "".join(lines))) == [
        "/turtlesim1/turtle1/cmd_vel",
        "/turtlesim2/turtle1/cmd_vel",
    ]


def test_arguments_that_ros_can_not_parse_are_reported():
    status, stdout, stderr = ended("--world", "turtlesim", "--headless", "--ros-args", "--nonsense")
    assert (status, stdout) == (2, "")
    assert stderr == "ROS can't read --ros-args --nonsense: ['--nonsense']\n"
    with pytest.raises(ArgumentsError) as refused:
        own_words(["--headless", "--ros-args", "-r", "x"])
    begin = (
        "ROS can't read --ros-args -r x: Failed to parse ROS arguments: Couldn't parse remap rule: '-r x'."
    )
    assert str(refused.value).startswith(begin)
