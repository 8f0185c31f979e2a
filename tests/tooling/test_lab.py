"""The lab for a real robot: what it measures, right and wrong drives, right and wrong reports."""

import dataclasses
import json
import subprocess
import sys
from pathlib import Path

import pytest
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.node import Node

from sim import Network, World, run

BRIDGE = Path(__file__).parents[2] / "course" / "bridge"
sys.path.insert(0, str(BRIDGE))  # as the notebooks import what is beside them
import lab  # noqa: E402
import lab_report  # noqa: E402

YARD = World.load("yard")
SHOWN = "{} as the bag shows it, within"
FORMULA = "predicted by the formula"


class Stops(Node):
    """Nothing is wrong with it; the others change one thing each."""

    speeds, driving, standing = (0.2, 0.4, 0.6), 40, 40  # m/s; ticks of 0.05 s
    kind = Twist

    def __init__(self):
        super().__init__("stops")
        self.ticks = 0
        self.commands = self.create_publisher(self.kind, "/cmd_vel", 10)
        self.create_timer(0.05, self.drive)

    def drive(self):
        turn, tick = divmod(self.ticks, self.driving + self.standing)
        self.ticks += 1
        speed = self.speeds[turn] if turn < len(self.speeds) else 0.0
        self.send(self.speed_at(tick, speed))

    def speed_at(self, tick, speed):
        return speed if tick < self.driving else 0.0

    def send(self, speed):
        command = Twist()
        command.linear.x = speed
        self.commands.publish(command if self.kind is Twist else TwistStamped(twist=command))


class Backwards(Stops):
    speeds = (-0.2, -0.3, -0.5)


class StampedCommands(Stops):
    kind = TwistStamped


class FiveStops(Stops):
    speeds, driving, standing = (0.3, 0.3, 0.6, 0.6, 0.1), 25, 25


class TwoStops(Stops):
    speeds = (0.2, 0.6)


class OneSpeed(Stops):
    speeds = (0.4, 0.4, 0.4)


class FallsSilent(Stops):
    def send(self, speed):
        if speed:
            super().send(speed)


class ComesDownInSteps(Stops):
    def speed_at(self, tick, speed):
        return speed if tick < 25 else speed * max(0.0, 1 - (tick - 25) / 15)


class DrivesOnAtOnce(Stops):
    speeds, driving, standing = (0.2, 0.4, 0.6), 40, 4


class Stands(Stops):
    speeds = (0.0, 0.0, 0.0)


RIGHT = [Stops, Backwards, StampedCommands, FiveStops]
WRONG = {
    TwoStops: (
        "2: from 0.20, 0.60 m/s",
        "Let it drive for 2 s before each stop, and stand for 2 s after it.",
    ),
    OneSpeed: ("3 stops, from 0.40, 0.40, 0.40 m/s", "Stop from other speeds, too."),
    FallsSilent: (
        "none",
        "The program falls silent in place of sending 0. Send a Twist() to stop, and go on sending it.",
    ),
    ComesDownInSteps: (
        "none",
        "The speed comes down in steps. Send 0 at once, so that the robot brakes and not your program.",
    ),
    DrivesOnAtOnce: (
        "1: from 0.60 m/s",
        "Let it drive for 2 s before each stop, and stand for 2 s after it.",
    ),
    Stands: ("none", "Let it drive for 2 s before each stop, and stand for 2 s after it."),
}


def bag(folder, node, braking=1.0, delay=0.1):
    """The bag of a drive of a robot that brakes so (m/s²), over a radio that is so late (s)."""
    stamped = node.kind is TwistStamped
    robot = dataclasses.replace(YARD.robot, max_acceleration=braking, stamped=stamped)
    world = dataclasses.replace(YARD, robot=robot)
    recording = run(node, world=world, seconds=13, network=Network(delay=delay), quiet=True)
    return recording.save_bag(folder / "my_drive", lab.TOPICS)


def report(folder):
    """What a student reports who has measured everything right."""
    drive = lab.read(folder)
    stops = lab.stops(drive)
    fastest = max(stops, key=lambda stop: stop.speed, default=lab.Stop(0.0, 0.5, 0.1, 1.0, 0.2))
    names = ("speed", "reaction", "braking", "distance", "predicted")
    numbers = {name: getattr(fastest, name) for name in names}
    scans = {"scan_reliability": "reliable", "scan_rate": drive.scan_rate, "scan_age": drive.scan_age}
    return scans | numbers


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    """The bag of a right drive."""
    return bag(tmp_path_factory.mktemp("lab"), Stops)


@pytest.mark.parametrize(("braking", "delay"), [(2.0, 0.0), (1.0, 0.1), (0.5, 0.2)])
def test_what_is_measured_is_what_the_robot_does(tmp_path, braking, delay):
    drive = lab.read(bag(tmp_path, Stops, braking, delay))
    assert drive.scan_rate == pytest.approx(20.0, rel=0.01)
    assert drive.scan_age == pytest.approx(0.03, abs=0.003)
    assert drive.reliability == {"/cmd_vel": "reliable", "/odom": "reliable", "/scan": "reliable"}
    stops = lab.stops(drive)
    assert [stop.speed for stop in stops] == pytest.approx([0.2, 0.4, 0.6])
    for stop in stops[1:]:
        assert stop.braking == pytest.approx(braking, rel=0.1)
        assert stop.reaction == pytest.approx(delay + 0.03, abs=0.02)  # and what the bag's recorder adds
        assert stop.predicted == pytest.approx(stop.distance, abs=0.01)


@pytest.mark.parametrize("node", RIGHT)
def test_a_right_drive_with_a_right_report_has_all_points(tmp_path, node):
    made = bag(tmp_path, node)
    score = lab_report.lab_score(made, report(made))
    assert [verdict.sentence for verdict in score.verdicts if verdict.status != "passed"] == []
    assert float(score) == score.max == 21


@pytest.mark.parametrize(("node", "words"), WRONG.items())
def test_a_wrong_drive_is_named(tmp_path, node, words):
    made = bag(tmp_path, node)
    score = lab_report.lab_score(made, report(made))
    first = score.verdicts[0]
    assert (first.status, first.saw, first.hint) == ("failed", *words)
    assert first.expected == "3 stops or more, 0.1 m/s apart"
    assert [verdict.status for verdict in score.verdicts[3:6]] == ["skipped"] * 3


@pytest.mark.parametrize(
    ("changed", "name", "expected", "hint"),
    [
        ({"scan_reliability": "best_effort"}, "scan_reliability", "reliable", "`ros2 topic info -v /scan`"),
        ({"scan_age": 30.0}, "scan_age", f"{SHOWN.format('scan_age')} 20 % or 0.005 s", lab_report.UNIT),
        ({"scan_age": -0.03}, "scan_age", SHOWN.format("scan_age"), "The time at which a scan was recorded"),
        ({"reaction": 131.0}, "reaction", "reaction as the bag shows it, within 0.06 s", lab_report.UNIT),
        ({"reaction": 0.73}, "reaction", "reaction as", "That is the time until it stands."),
        ({"reaction": 0.3}, "reaction", "reaction as", "From the first command of 0 until the speed"),
        ({"braking": -1.0}, "braking", "braking as the bag shows it, within 20 %", "It is the size of"),
        ({"braking": 0.82}, "braking", "", ""),
        ({"braking": 2.0}, "braking", "braking as", "Speed divided by the time in which it falls to 0"),
        ({"distance": 26.0}, "distance", f"{SHOWN.format('distance')} 10 % or 0.02 m", lab_report.UNIT),
        ({"distance": 0.18}, "distance", "distance as", "That is the braking alone."),
        ({"distance": 0.5}, "distance", "distance as", "From where the robot was at the first command of 0"),
        ({"predicted": 0.44}, "predicted", f"{FORMULA}, within 2 % or 0.001 m", "The half is missing"),
        ({"predicted": 0.18}, "predicted", FORMULA, "The reaction is missing"),
        ({"predicted": 0.38}, "predicted", FORMULA, "The speed is squared"),
        ({"predicted": 1.0}, "predicted", FORMULA, "speed · reaction + speed² / (2 · braking)"),
        ({"predicted": None}, "predicted", "a number as 'predicted'", "Fill in the whole report."),
        ({"braking": 0}, "predicted", "a braking above 0", "Measure it first."),
    ],
)
def test_a_wrong_number_is_named(drive, changed, name, expected, hint):
    wrong = report(drive) | {"speed": 0.6, "reaction": 0.13, "braking": 1.0, "predicted": 0.258} | changed
    score = lab_report.lab_score(drive, wrong)
    found = [verdict for verdict in score.verdicts if verdict.status == "failed" and name in verdict.sentence]
    if not expected:
        assert found == []
        return
    assert found[0].expected.startswith(expected)
    assert found[0].hint.startswith(hint)


def test_a_recording_without_odometry_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(lab, "TOPICS", ("/cmd_vel", "/scan"))
    first = lab_report.lab_score(bag(tmp_path, Stops), {}).verdicts[0]
    assert (first.saw, first.hint) == ("none", "Record /odom, too: it shows how fast the robot was.")


def test_the_course_s_own_recorder_stores_the_qos_with_the_messages(drive, tmp_path):
    about = Path(drive, "metadata.yaml").read_text("utf-8")
    assert lab._first("- reliability: 2\n  depth: 5\n") == "best_effort"
    assert lab._first([{"reliability": "best_effort"}]) == "best_effort"
    assert lab._first("") == lab._first(None) == "unknown"
    assert "reliability: 1" in about


def test_the_score_can_be_printed_in_a_terminal(drive, tmp_path):
    file = tmp_path / "report.json"
    file.write_text(json.dumps(report(drive) | {"distance": 0.5}), "utf-8")
    command = [sys.executable, BRIDGE / "lab_report.py", drive, file]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines[-1] == "18 of 21 points"
    assert any(f"Expected {SHOWN.format('distance')} 10 % or 0.02 m; saw 0.5 m. " in line for line in lines)
