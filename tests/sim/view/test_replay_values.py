"""What a replay shows at each moment: the strip of values, the messages of a topic, and when it ends."""

import math

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from sim import run
from sim.evidence import Message, Pose
from sim.ros.messages.codec import encode
from sim.view import replay_data
from sim.view.last_event import last_event
from sim.view.packing import inflated
from sim.view.replay_data import pack
from sim.view.replay_values import MESSAGES, inspected, strip_of
from tests.sim.recordings import driven, published, recording
from tests.sim.warehouse import order, worked


class Stops(Node):
    """Drives for 3 s, then stands still, and publishes its state."""

    def __init__(self):
        super().__init__("stops")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.state = self.create_publisher(String, "state", 10)
        self.ticks = 0
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.ticks += 1
        twist = Twist()
        twist.linear.x = 0.2 if self.ticks < 30 else 0.0
        self.publisher.publish(twist)
        self.state.publish(String(data="drives" if self.ticks < 30 else "stands"))


@pytest.fixture(scope="module")
def drive():
    return run(Stops, world="room", seconds=20, quiet=True)


def unpacked(strip):
    """The strip as one dictionary for each stamp (s)."""
    found, last = [], {}
    total = 0
    for index, difference in enumerate(strip["stamps"]):
        total += difference
        for label, column in zip(strip["labels"], strip["values"], strict=True):
            if column[index] != 0:
                last[label] = column[index]
        found.append((total / 1000, dict(last)))
    return found


def texts(messages):
    lines, found = [], []
    for changes in messages["texts"]:
        lines = [lines[index] if line == 0 else line for index, line in enumerate(changes)]
        found.append(lines)
    return found


def test_the_strip_has_the_values_of_the_live_view_at_each_moment(drive):
    rows = dict(unpacked(strip_of(drive)))
    pose, commands = ["x", "y", "yaw", "v", "ω"], ["command v", "command ω"]
    assert strip_of(drive)["labels"] == [*pose, *commands, "nearest", "at", "bumper", "goal", "contacts"]
    assert rows[0.0]["command v"] == "none yet"
    middle = min(rows, key=lambda stamp: abs(stamp - 2.0))
    assert (rows[middle]["v"], rows[middle]["command v"]) == ("0.20 m/s", "0.20 m/s")
    assert (rows[20.0]["v"], rows[20.0]["contacts"]) == ("0.00 m/s", "none")


def test_a_machine_s_joints_are_in_the_strip():
    recording = run(world="arm", seconds=1, quiet=True)
    assert strip_of(recording)["labels"] == ["shoulder_joint", "elbow_joint"]


def test_a_run_without_a_world_has_no_strip():
    assert strip_of(recording()) == {"labels": [], "stamps": [], "values": []}


def test_the_messages_of_a_topic_are_there_as_text_with_what_can_be_plotted(drive):
    state, odom = inspected(drive, ["/state", "/odom"])
    assert (state["type"], state["curves"]) == ("std_msgs/msg/String", [])
    assert texts(state)[0] == ["data: drives"]
    assert texts(state)[-1] == ["data: stands"]
    (field, line), *_ = odom["curves"]
    assert field == "pose.pose.position.x"
    values = [float(text[line].split(": ")[1]) for text in texts(odom)]
    assert values == sorted(values)
    assert values[-1] == pytest.approx(drive.path[-1].x, abs=0.01)


def test_a_joint_has_a_curve_of_its_own_though_several_drivers_publish():
    arm = [JointState(name=["elbow_joint", "slider"], position=[n / 10, 2.0]) for n in range(3)]
    gripper = JointState(name=["gripper_joint"], position=[0.04])
    sent = [(0.0, arm[0]), (1.0, gripper), (2.0, arm[1]), (3.0, arm[2])]
    (found,) = inspected(published("/joint_states", sent, seconds=4.0), ["/joint_states"])
    assert found["curves"] == [["elbow_joint position", [0.0, None, 0.1, 0.2]]]


def test_messages_that_are_no_messages_are_left_out():
    broken = Message(1.0, "/a", "std_msgs/msg/String", "/a", b"")
    good = Message(2.0, "/a", "std_msgs/msg/String", "/a", encode(String(data="b")))
    (found,) = inspected(recording(published=[broken, good]), ["/a"])
    assert (found["stamps"], texts(found)) == ([2000], [["data: b"]])


def test_of_long_messages_there_are_few():
    """Texts that no packing makes smaller leave the replay small."""
    sent = [(n / 10, "".join(chr(0x3400 + n * k % 9973) for k in range(199))) for n in range(300)]
    run = published("/a", [(stamp, String(data=text)) for stamp, text in sent], seconds=30.0)
    (found,) = inspected(run, ["/a"])
    assert len(found["stamps"]) in MESSAGES[1:]
    assert (found["count"], found["stamps"][0], found["stamps"][-1]) == (300, 0, 29900)


def test_a_replay_ends_soon_after_the_last_thing_that_happens(drive):
    last = last_event(drive)
    assert 3.0 < last < 4.5
    data = inflated(pack(drive, 1.0))
    assert data["end"] == pytest.approx(last + replay_data.LEAD)
    assert data["marks"][-1][:2] == [20000, "end"]


def test_a_replay_of_a_drive_that_never_rests_ends_with_the_run():
    assert inflated(pack(driven([(n, 0) for n in range(6)]), 1.0))["end"] == 5.0


@pytest.mark.parametrize(("stamp", "opens"), [(10.0, 9.0), (0.4, 0.0)])
def test_a_replay_with_a_moment_opens_a_second_before_it_and_marks_it(drive, stamp, opens):
    data = inflated(pack(drive, 1.0, [(stamp, "it stood still"), (15.0, "and here")]))
    assert data["open"] == opens
    assert data["end"] == 16.0
    assert [stamp * 1000, "missed", f"t = {stamp:.3g} s: it stood still", None] in data["marks"]
    assert [mark[0] for mark in data["marks"]] == sorted(mark[0] for mark in data["marks"])


def test_a_replay_can_play_at_once(drive):
    assert "plays" not in inflated(pack(drive, 1.0))
    assert drive.replay(speed=2.0, plays=True).html != drive.replay(speed=2.0).html
    assert inflated(pack(drive, 1.0, plays=True))["plays"] is True


def test_a_replay_has_the_key_of_its_run(drive):
    assert inflated(pack(drive, 1.0))["run"] == drive.digest[:12]


def test_what_moves_by_less_than_a_millimeter_rests():
    path = [(0, 0), (1, 0), *[(1 + math.sin(n) * 1e-4, 0) for n in range(10)]]
    assert last_event(driven(path)) == 0.0


def test_a_warehouse_shows_what_the_robot_carries_what_waits_and_what_was_delivered():
    orders = [order(1, waiting=1.0, picked_up=3.0, delivered=6.0, robot="robot"), order(2, waiting=2.0)]
    way = [Pose(float(second), 0.0, 0.0, 0.0) for second in range(9)]
    rows = unpacked(strip_of(worked(*orders, path=way, seconds=8.0)))
    shown = [(stamp, row["carries"], row["orders waiting"], row["delivered"]) for stamp, row in rows]
    assert shown[0] == (0.0, "nothing", "0", "0")
    assert shown[2] == (2.0, "nothing", "2", "0")
    assert shown[4] == (4.0, "order 1", "1", "0")
    assert shown[8] == (8.0, "nothing", "1", "1")


def test_other_worlds_have_no_orders(drive):
    assert "carries" not in strip_of(drive)["labels"]
