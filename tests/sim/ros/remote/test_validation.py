"""Bytes from the other process are a valid message or refused."""

import random

import pytest
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rcl_interfaces.msg import Parameter, ParameterEvent
from rclpy.qos import (
    QoSProfile,
    qos_profile_action_status_default,
    qos_profile_best_available,
    qos_profile_parameter_events,
    qos_profile_sensor_data,
)
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.remote.validation import (
    MAX_TOTAL_TEXT,
    ProtocolError,
    TextBudget,
    qos_to_list,
    valid_message,
    valid_message_bytes,
    valid_qos,
)

MESSAGES = (
    String(data="hello world"),
    LaserScan(ranges=[1.0] * 360),
    Odometry(),
    Path(poses=[PoseStamped()] * 5),
    OccupancyGrid(data=[0] * 500),
    ParameterEvent(new_parameters=[Parameter(name="speed")]),
)


@pytest.mark.parametrize("original", MESSAGES, ids=lambda original: type(original).__name__)
def test_a_valid_message_is_unchanged(original):
    found, raw = valid_message(encode(original), type(original), "a message")
    assert found == original
    assert valid_message(bytes(raw), type(original), "a message")[0] == original
    name = type_name(type(original))
    assert canonical(name, valid_message_bytes(encode(original), type(original), "")) == canonical(name, raw)


@pytest.mark.parametrize("sent", [encode(Twist())[:-1], encode(Twist())[:20], "a text", 7, None])
def test_bytes_that_are_no_twist_are_refused(sent):
    with pytest.raises(ProtocolError, match=r"^a command that is not of type geometry_msgs/msg/Twist$"):
        valid_message_bytes(sent, Twist, "a command")


def test_names_count_once_and_other_texts_each_time(monkeypatch):
    monkeypatch.setattr("sim.ros.remote.validation.MAX_CACHED_NAMES", 2)
    texts, name = TextBudget(), "n" * 200
    for _ in range(MAX_TOTAL_TEXT // len(name) + 1):
        assert texts.name(name, "a name") == name
    assert texts.name("/lidar\ud83d", "a name") == "/lidar?"
    texts.take("t" * 10, "a text", 10)
    with pytest.raises(ProtocolError, match=r"^a name that is not a text$"):
        texts.name(["a", "list"], "a name")
    words = f"more than {MAX_TOTAL_TEXT} characters of log lines, names and other texts"
    with pytest.raises(ProtocolError, match=f"^{words}$"):
        for _ in range(MAX_TOTAL_TEXT // len(name) + 1):  # one too many to be known
            texts.name("m" * len(name), "a name")


@pytest.mark.parametrize("original", MESSAGES, ids=lambda original: type(original).__name__)
def test_corrupted_bytes_are_another_message_or_refused(original):
    chance = random.Random(5)
    refused = 0
    for _ in range(500):
        raw = bytearray(encode(original))
        cut = chance.randrange(len(raw))
        if chance.random() < 0.5:
            raw = raw[:cut] + chance.randbytes(chance.randrange(20))
        else:
            raw[cut : cut + 4] = chance.choice(
                (b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", chance.randbytes(4))
            )
        try:
            _, written = valid_message(bytes(raw), type(original), "a message")
        except ProtocolError:
            refused += 1
        else:
            valid_message(written, type(original), "a message")
    assert refused > 0


@pytest.mark.parametrize(
    "profile",
    [
        QoSProfile(depth=7),
        qos_profile_sensor_data,
        qos_profile_action_status_default,
        qos_profile_parameter_events,
        qos_profile_best_available,
    ],
)
def test_a_qos_profile_survives_the_wire(profile):
    assert valid_qos(qos_to_list(profile)) == profile
