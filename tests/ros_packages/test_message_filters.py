"""Filters of messages alone, in runs, and outside a run."""

from types import SimpleNamespace

import pytest
import rclpy
from geometry_msgs.msg import PointStamped
from message_filters import ApproximateTimeSynchronizer, Cache, SimpleFilter, Subscriber, TimeSynchronizer
from rclpy.clock import ClockType
from rclpy.time import Time
from std_msgs.msg import String

CACHE_WARNING = (
    "can not use message filters messages without timestamp infomation when 'allow_headerless' is disabled. "
    "auto assign ROSTIME to headerless messages once enabling constructor option of 'allow_headerless'."
)
PAIR_WARNING = CACHE_WARNING.replace("filters messages", "filters for messages")


def stamped(seconds: float, value: float = 0.0) -> PointStamped:
    message = PointStamped()
    message.header.stamp = Time(seconds=seconds).to_msg()
    message.point.x = value
    return message


def at(seconds: float) -> Time:
    return Time(seconds=seconds, clock_type=ClockType.ROS_TIME)


def synchronized(synchronizer, *arguments, messages) -> list[tuple[float, ...]]:
    """What a synchronizer of two inputs passes on of messages (input, seconds): the seconds of each pair."""
    inputs = [SimpleFilter(), SimpleFilter()]
    filtered = synchronizer(inputs, *arguments)
    pairs = []
    filtered.registerCallback(lambda *pair: pairs.append(tuple(message.point.x for message in pair)))
    for index, seconds in messages:
        inputs[index].signalMessage(stamped(seconds, float(seconds)))
    return pairs


def test_callbacks_get_the_messages_and_their_own_arguments_in_order():
    source, calls = SimpleFilter(), []
    assert source.registerCallback(lambda *arguments: calls.append(arguments), "a", 1) == 0
    assert source.registerCallback(lambda *arguments: calls.append(arguments)) == 1
    source.signalMessage("one", "two")
    assert calls == [("one", "two", "a", 1), ("one", "two")]


def test_a_cache_stores_the_latest_messages_and_finds_them_by_time():
    source = SimpleFilter()
    cache, passed = Cache(source, 3), []
    cache.registerCallback(passed.append)
    assert (cache.getLast(), cache.getOldestTime(), cache.getLastestTime()) == (None, None, None)
    messages = [stamped(seconds) for seconds in range(5)]
    for message in messages:
        source.signalMessage(message)
    assert passed == messages
    assert cache.getInterval(at(1), at(3)) == messages[2:4]
    assert cache.getInterval(at(0), at(9)) == messages[2:]
    assert cache.getElemAfterTime(at(2.5)) is messages[3]
    assert cache.getElemBeforeTime(at(3.5)) is messages[3]
    assert cache.getElemAfterTime(at(4.5)) is None
    assert cache.getElemBeforeTime(at(1.5)) is None
    assert (cache.getOldestTime(), cache.getLastestTime()) == (at(2), at(4))
    assert cache.getLast() is messages[4]
    with pytest.raises(AssertionError):
        cache.getInterval(at(2), at(1))


def test_a_stamp_may_be_a_time_of_rclpy():
    cache = Cache(SimpleFilter())
    message = SimpleNamespace(header=SimpleNamespace(stamp=Time(seconds=2)))
    cache.add(message)
    assert cache.getLastestTime() == Time(seconds=2)


def test_equal_stamps_are_combined_in_the_order_of_time():
    late = [(0, 1), (0, 2), (0, 3), (1, 3), (1, 2)]
    assert synchronized(TimeSynchronizer, 10, messages=late) == [(3, 3), (2, 2)]
    assert synchronized(TimeSynchronizer, 10, messages=[(0, 1), (1, 1.001)]) == []


def test_a_full_queue_loses_its_oldest_stamp():
    messages = [(0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3)]
    assert synchronized(TimeSynchronizer, 2, messages=messages) == [(2, 2), (3, 3)]
    assert synchronized(ApproximateTimeSynchronizer, 2, 0.1, messages=messages) == [(2, 2), (3, 3)]
    older = [(0, 2), (0, 1), (1, 1.05)]
    assert synchronized(ApproximateTimeSynchronizer, 1, 0.1, messages=older) == []


def test_stamps_that_are_less_than_the_slop_apart_are_combined_the_nearest_first():
    apart = [(0, 1.0), (0, 1.25), (1, 1.375)]
    assert synchronized(ApproximateTimeSynchronizer, 10, 0.5, messages=apart) == [(1.25, 1.375)]
    assert synchronized(ApproximateTimeSynchronizer, 10, 0.125, messages=apart) == []  # exactly the slop


def test_three_inputs_are_combined_if_all_are_near_each_other():
    inputs, calls = [SimpleFilter() for _ in range(3)], []
    filtered = ApproximateTimeSynchronizer(inputs, 5, 0.2)
    filtered.registerCallback(lambda *messages: calls.append(len(messages)))
    for source, seconds in zip(inputs, (1.0, 1.15, 1.3), strict=True):
        source.signalMessage(stamped(seconds))
    assert calls == []  # the first and the last are 0.3 s apart
    inputs[0].signalMessage(stamped(1.125))
    assert calls == [3]


def test_a_subscriber_is_not_copied_endlessly_before_it_has_a_subscription():
    with pytest.raises(AttributeError, match=r"^sub$"):
        Subscriber.__new__(Subscriber).__getattr__("topic_name")


def test_a_program_with_filters_runs_outside_a_run(capfd):
    rclpy.init()
    node = rclpy.create_node("alone")
    cache = Cache(Subscriber(node, String, "chatter"), allow_headerless=False)
    cache.add(String())
    node.destroy_node()
    rclpy.shutdown()
    assert f"[message_filters_cache]: {CACHE_WARNING}" in capfd.readouterr().err
