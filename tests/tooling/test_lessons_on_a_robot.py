"""The lessons' programs as real processes beside `python -m sim`: what runs in a notebook runs on a robot."""

import json
import re
import subprocess
import sys

import pytest

from tests.sim.standalone.programs import REPOSITORY, environment, robot
from tests.tooling.lesson_programs import ROOT, definitions

COMMANDS = {"/cmd_vel": ("geometry_msgs/msg/Twist", "linear.x")}
BLINKS = "']: on' in errors and ']: off' in errors"
STOPPED = "received['/cmd_vel'][-1] == 0.0"
A_WHILE = "len(received['/odom']) > 40"  # where there is nothing to wait for
LESSONS = sorted(f"{path.parent.name}/{path.stem}" for path in ROOT.glob("course/[0-9]*/*.ipynb"))
BOTH = pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])


@pytest.fixture(scope="module")
def yard():
    """One robot for all."""
    with robot("--world", "yard", "--headless") as running:
        yield running


def asked(running, errors, **spec):
    """Run lesson_programs in the robot's domain; what it found."""
    words = json.dumps(spec | {"errors": str(errors)})
    domain = {"ROS_DOMAIN_ID": str(running.domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    done = subprocess.run(
        [sys.executable, "-m", "tests.tooling.lesson_programs", words],
        cwd=REPOSITORY, env=environment(**domain), capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def ran(
    yard, errors, lesson, programs, number="SIGINT",
    until="True", at_end="True", alone=False, listen=None, **arguments,
):  # fmt: skip
    """As `lesson_programs.together`. programs: names, or dictionaries. arguments: of the one of this name."""
    programs = [each if isinstance(each, dict) else {"name": each} for each in programs]
    programs = [each | {"arguments": arguments.get(each["name"])} for each in programs]
    listen = listen or {"/odom": ("nav_msgs/msg/Odometry", "pose.pose.position.x")}
    return asked(
        yard, errors,
        lesson=lesson, programs=programs, signal=number, listen=listen,
        until=until, at_end=at_end, alone=alone,
    )  # fmt: skip


@pytest.mark.parametrize("lesson", LESSONS)
def test_what_a_lesson_defines_can_be_taken_out_of_it(lesson):
    in_files = lesson == "11_packages/lesson"  # what it has of programs is in files
    assert ("import " in definitions(lesson)) != in_files


@BOTH
def test_the_main_of_lesson_1_ends_quietly(yard, tmp_path, number):
    found = ran(yard, tmp_path / "errors", "01_nodes", ["main"], number, until=BLINKS)
    assert found["ended"] == [0], found["errors"]
    assert {line.split("]: ")[1] for line in found["errors"].splitlines()} == {"on", "off"}


@BOTH
def test_the_main_of_lesson_2_stops_its_robot(yard, tmp_path, number):
    lesson = "02_topics/connecting"
    found = ran(yard, tmp_path / "errors", lesson, ["main"], number, listen=COMMANDS, at_end=STOPPED)
    assert found["ended"] == [0], found["errors"]
    assert found["received"]["/cmd_vel"][-2:] == [0.3, 0.0]
    assert found["errors"] == ""


def test_the_server_of_lesson_4_drives(yard, tmp_path):
    before = ran(yard, tmp_path / "nothing", "04_actions/driving", [])["received"]["/odom"][-1]
    until = f"'canceled after' in errors and max(received['/odom']) > {before}"
    found = ran(yard, tmp_path / "errors", "04_actions/driving", ["whole.main", "Nervous"], until=until)
    assert found["ended"] == [0, 0], found["errors"]
    assert float(re.search(r"canceled after ([\d.]+) m", found["errors"])[1]) > 0
    assert max(found["received"]["/odom"]) > before


@BOTH
@pytest.mark.soak
def test_the_navigator_of_lesson_6_ends_quietly(yard, tmp_path, number):
    found = ran(yard, tmp_path / "errors", "06_navigator/navigating", ["whole.main"], number, until=A_WHILE)
    assert (found["ended"], found["errors"]) == ([0], "")


@pytest.mark.soak
@pytest.mark.parametrize(("listener", "receives"), [("Listener", False), ("EasyListener", True)])
def test_a_best_effort_publisher_is_received_with_the_sensor_profile_only(yard, tmp_path, listener, receives):
    until = f"({'I heard: Hello' if receives else 'incompatible QoS'!r} in errors) and {A_WHILE}"
    found = ran(yard, tmp_path / "errors", "02_topics/connecting", [listener, "CarelessTalker"], until=until)
    assert found["ended"] == [0, 0], found["errors"]
    assert ("I heard: Hello" in found["errors"]) == receives
    assert ("incompatible QoS" in found["errors"]) == (not receives)


@pytest.mark.soak
def test_between_two_processes_a_wrong_type_is_silence(yard, tmp_path):
    found = ran(yard, tmp_path / "errors", "02_topics", ["Listener", "NumberTalker"], until=A_WHILE)
    assert (found["ended"], found["errors"]) == ([0, 0], "")


@pytest.mark.soak
def test_two_nodes_of_one_name_start_without_a_warning(yard, tmp_path):
    found = ran(yard, tmp_path / "errors", "01_nodes", ["Ticker", "Ticker"], until=A_WHILE)
    assert found["ended"] == [0, 0], found["errors"]
    assert "WARN" not in found["errors"]


@pytest.mark.soak
def test_what_awaits_needs_a_group_of_its_own(yard, tmp_path):
    ran(yard, tmp_path / "one", "03_services", ["Adder", "Awaiting"], until="'1 + 2 + 3 = 6' in errors")
    found = ran(yard, tmp_path / "other", "03_services", ["Adder", "StillFrozen"], until=A_WHILE)
    assert "The sum is" not in found["errors"]


@pytest.mark.soak
@pytest.mark.parametrize(("circler", "words"), [
    ("CarefulCircler", "the radius must be 0.2 m or more"),
    ("RangedCircler", "Parameter radius out of range"),
    ("Circler", "ZeroDivisionError"),
])  # fmt: skip
def test_a_bad_start_value_is_refused_where_the_check_comes_first(yard, tmp_path, circler, words):
    radius = {circler: ["-p", "radius:=0.0"]}
    found = ran(yard, tmp_path / "errors", "03_services/parameters", [circler], alone=True, **radius)
    assert found["ended"] == [1], found["errors"]
    assert words in found["errors"].splitlines()[-1]


@pytest.mark.soak
def test_the_patrol_of_lesson_4_comes_back(yard, tmp_path):
    names, until = ["whole.main", "SpinServer", "Patrol"], "errors.count(': done') >= 4"
    found = ran(yard, tmp_path / "errors", "04_actions/driving", names, until=until)
    assert found["ended"] == [0, 0, 0], found["errors"]
    assert found["errors"].count(": done") == 4


@pytest.mark.soak
def test_the_guard_of_lesson_5_lets_harmless_commands_through(yard, tmp_path):
    raw = {"Blind": ["-r", "/cmd_vel:=/cmd_vel_raw"]}
    names, until = ["WholeGuard", "Blind"], "received['/cmd_vel'].count(0.4) > 20"
    found = ran(yard, tmp_path / "errors", "05_sensing/guarding", names, until=until, listen=COMMANDS, **raw)
    assert (found["ended"], found["errors"]) == ([0, 0], "")
    assert found["received"]["/cmd_vel"][-1] == 0.4


@pytest.mark.soak
def test_the_driver_of_lesson_7_stops_when_the_joystick_falls_silent(yard, tmp_path):
    until = f"max(received['/cmd_vel']) == 0.4 and 'The joystick is late: stop' in errors and {STOPPED}"
    names = ["Driver", "Joystick"]
    found = ran(yard, tmp_path / "errors", "07_silence", names, until=until, listen=COMMANDS)
    assert found["ended"] == [0, 0], found["errors"]
    assert max(found["received"]["/cmd_vel"]) == 0.4


@pytest.mark.soak
def test_the_seven_positions_of_lesson_8_are_sent_and_the_program_ends(tmp_path):
    with robot("--world", "joint", "--headless") as joint:
        listen = {"/joint_commands": ("std_msgs/msg/Float64", "data")}
        publisher = {"name": "JointPublisher", "subscribers": {"/joint_commands": 3}}  # one is the robot's
        until = "len(received['/joint_commands']) >= 7 and 'All positions are sent' in errors"
        until += " and errors.count('Received joint position') >= 7"
        programs = [publisher, "JointSubscriber"]
        found = ran(joint, tmp_path / "errors", "08_joints", programs, until=until, listen=listen)
    assert found["ended"] == [0, 0], found["errors"]
    assert found["received"]["/joint_commands"] == [0.0, 0.5, -0.5, 0.0, 1.0, -1.0, 0.0]
    assert found["errors"].count("]: Received joint position: ") == 7
    assert found["errors"].count("]: All positions are sent") == 1


@pytest.mark.soak
def test_the_arm_of_lesson_8_draws_its_star(tmp_path):
    with robot("--world", "arm", "--headless") as arm:
        listen = {"/joint_states": ("sensor_msgs/msg/JointState", "header.stamp.sec")}
        until = "']: The goal was reached.' in errors"
        found = ran(arm, tmp_path / "errors", "08_joints", ["goal.Artist"], listen=listen, until=until)
    assert found["ended"] == [0], found["errors"]


@pytest.mark.soak
def test_the_follower_of_lesson_9_drives_after_its_carrot(yard, tmp_path):
    names, until = ["Carrot", "Follower"], "max(received['/cmd_vel']) > 0.2"
    found = ran(yard, tmp_path / "errors", "09_frames", names, until=until, listen=COMMANDS)
    assert found["ended"] == [0, 0], found["errors"]


@BOTH
@pytest.mark.soak
def test_the_pole_of_lesson_10_answers_within_its_limit_and_ends_quietly(tmp_path, number):
    """In real time the pole has fallen before anybody is there; what is sent then is at the motor's limit."""
    efforts = {"/cart_effort": ("std_msgs/msg/Float64", "data")}
    with robot("--world", "cart_pole", "--headless") as cart:
        until = "len(received['/cart_effort']) > 20 and max(map(abs, received['/cart_effort'])) >= 10"
        found = ran(cart, tmp_path / "errors", "10_control", ["pole_main"], number, until, listen=efforts)
    assert (found["ended"], found["errors"]) == ([0], "")
    assert max(map(abs, found["received"]["/cart_effort"])) == 10.0


@BOTH
@pytest.mark.soak
def test_the_watchdog_of_lesson_12_sends_zeros_where_no_one_drives(yard, tmp_path, number):
    until = "len(received['/cmd_vel']) > 5"
    found = ran(yard, tmp_path / "errors", "12_safety", ["watchdog_main"], number, until, listen=COMMANDS)
    assert (found["ended"], found["errors"]) == ([0], "")
    assert set(found["received"]["/cmd_vel"]) == {0.0}


@pytest.mark.soak
def test_the_three_programs_of_lesson_13_set_out_for_an_order(tmp_path):
    listen = {"/state": ("std_msgs/msg/String", "data"), **COMMANDS}
    with robot("--world", "warehouse", "--headless") as warehouse:
        names = ["Perception", "Decision", "Control"]
        until = "'fetch' in received['/state'] and max(received['/cmd_vel']) > 0.2"
        found = ran(warehouse, tmp_path / "errors", "13_delivery", names, until=until, listen=listen)
    assert (found["ended"], found["errors"]) == ([0, 0, 0], "")


@pytest.mark.soak
def test_the_inspector_of_lesson_14_reports_on_a_robot_s_lidar(yard, tmp_path):
    found = ran(yard, tmp_path / "errors", "14_localization", ["Inspector"], until="'longest gap' in errors")
    assert found["ended"] == [0], found["errors"]
    assert "frames ['base_scan']" in found["errors"]


@pytest.mark.soak
def test_the_fusion_of_lesson_14_publishes_and_ends_quietly(tmp_path):
    """By SIGTERM: at 120 messages a second, a Ctrl-C once became a RuntimeError in a take."""
    listen = {"/odometry/filtered": ("nav_msgs/msg/Odometry", "pose.pose.orientation.w")}
    until = "len(received['/odometry/filtered']) > 20"
    with robot("--world", "lab", "--headless") as lab:
        lesson, errors = "14_localization/covariance", tmp_path / "errors"
        found = ran(lab, errors, lesson, ["main"], "SIGTERM", until, listen=listen)
    assert (found["ended"], found["errors"]) == ([0], "")
    assert found["received"]["/odometry/filtered"][-1] == pytest.approx(1.0, abs=0.1)


@pytest.mark.soak
def test_the_localizer_of_lesson_14_begins_with_a_click_and_ends_quietly(tmp_path):
    listen = {"/amcl_pose": ("geometry_msgs/msg/PoseWithCovarianceStamped", "pose.pose.position.x")}
    with robot("--world", "warehouse", "--headless") as warehouse:
        programs = ["localizer.main", {"name": "Click", "subscribers": {"/initialpose": 1}}]
        until = "len(received['/amcl_pose']) > 10"
        lesson, errors = "14_localization/localization", tmp_path / "errors"
        found = ran(warehouse, errors, lesson, programs, "SIGTERM", until, listen=listen)
    assert (found["ended"], found["errors"]) == ([0, 0], "")
    assert found["received"]["/amcl_pose"][-1] == pytest.approx(0.15, abs=0.5)
