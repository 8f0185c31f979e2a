"""Measures over what was published: who sends what, how often, with which values."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Sequence
from typing import Any

from grader.checks.check import Missed
from grader.checks.ends import declared
from grader.checks.work import worked_until
from grader.geometry.near import is_near
from sim.evidence import Endpoint, Message, Recording, Seconds
from sim.evidence import rate as mean_rate


def publishes(recording: Recording, topic: str, type: str = "", *, at_least: int = 1) -> list[Message]:
    """The messages on a topic, at least so many of them and all of one type, e.g. "std_msgs/msg/String".

    Raises Missed when the topic, its type or the messages are not there.
    """
    expected = f"messages of type {type} on {topic}" if type else f"messages on {topic}"
    declared(recording, "publisher", topic, type, expected)
    received = recording.messages(topic)
    if len(received) < at_least:
        few = f"only {len(received)} in {recording.ended.stamp:.3g} s"
        saw = few if received else "a publisher, but no message"
        expected = expected if at_least == 1 else f"{at_least} or more {expected}"
        again = "Publish in a timer's callback each time it is called, from start to end." if received else ""
        raise Missed(expected, saw, guess=again, picture="topics")
    return received


def subscribes(recording: Recording, topic: str, type: str = "") -> list[Endpoint]:
    """The subscriptions to a topic. Raises Missed when there is none, or one of another type."""
    expected = f"a subscription to {topic}" + (f" of type {type}" if type else "")
    return declared(recording, "subscription", topic, type, expected)


def rate(recording: Recording, topic: str, hz: float, *, tolerance: float = 0.1) -> float:
    """The mean rate on a topic in Hz of simulated time. Raises Missed when it is off, or after a long pause.

    tolerance: as a fraction of `hz`. The first message may come two periods after the nodes' start.
    """
    stamps = [received.stamp for received in publishes(recording, topic, at_least=2)]
    expected = f"{hz:.4g} Hz on {topic}, within {tolerance:.0%}"
    _can_be_received(recording, topic, expected)
    measured = mean_rate(stamps)
    if not is_near(measured, hz, tolerance * hz):
        saw = f"{measured:.4g} Hz ({len(stamps)} messages in {recording.ended.stamp:.3g} s)"
        raise Missed(expected, saw, _rate_hint(recording, measured, hz), picture="topics")
    pause, since = longest_pause([recording.started_at, *stamps, worked_until(recording)])
    if pause > 2.5 / hz:
        saw = f"no message for {pause:.3g} s, from {since:.3g} s on"
        raise Missed(
            expected, saw, "Publish from start to end, in the callback of a timer.", picture="topics"
        )
    return measured


def keeps_pace(recording: Recording, topic: str, hint: str) -> None:
    """Messages are published at 10 Hz. Raises Missed; what delays them is a slow callback."""
    from grader.diagnosis.activity import slow_callback

    try:
        rate(recording, topic, 10.0)
    except Missed as missed:
        missed.hint = slow_callback(recording) or hint  # rate's own is for timers of another period
        raise


def _can_be_received(recording: Recording, topic: str, expected: str) -> None:
    from grader.diagnosis.connections import publisher_for_each_message

    lost = publisher_for_each_message(recording, topic)
    if lost:
        raise Missed(expected, "messages that are never received", lost, picture="topics")


def longest_pause(moments: Sequence[Seconds]) -> tuple[Seconds, Seconds]:
    """The longest time between two moments in a row, and when it began; zeros for fewer than two."""
    pairs = itertools.pairwise(moments)
    return max(((after - before, before) for before, after in pairs), default=(0.0, 0.0))


def lasts(recording: Recording, topic: str, *, pause: Seconds = 1.0) -> None:
    """Messages on a topic come until the end of the run's time: the last one at most `pause` before it.

    Raises Missed if not. What ended or got stuck needs none later: its credit is for the part it had.
    """
    last = publishes(recording, topic)[-1].stamp
    end = worked_until(recording)
    if last < end - pause:
        raise Missed(
            f"messages on {topic} until the end, at {end:g} s",
            f"the last one at {last:.3g} s",
            guess="Publish from start to end, in a callback that is called again and again.",
            picture="topics",
        )


def _rate_hint(recording: Recording, measured: float, hz: float) -> str:
    from grader.diagnosis.activity import slow_callback

    slow = slow_callback(recording)
    if slow or measured == 0:
        return slow
    return f"A timer with a period of {1 / hz:.4g} s gives {hz:.4g} Hz: the period is 1 / rate, in seconds."


def within(
    recording: Recording, topic: str, field: str, low: float, high: float, *, unit: str = ""
) -> list[float]:
    """The values of a field, e.g. "linear.x", all from `low` to `high`. Partial credit for the part that is.

    Raises Missed for the first value outside, NaN included, and when there is no message.
    """
    publishes(recording, topic)
    points = series(recording, topic, field)
    outside = [(stamp, value) for stamp, value in points if not low <= value <= high]
    if outside:
        stamp, value = outside[0]
        unit = f" {unit}" if unit else ""
        raise Missed(
            f"{field} on {topic} from {low:g} to {high:g}{unit}",
            f"{value:.4g}{unit} at {stamp:.3g} s; {len(outside)} of {len(points)} are outside",
            "NaN means that a calculation had no result." if math.isnan(value) else "",
            picture="topics",
        )
    return [value for _, value in points]


def series(recording: Recording, topic: str, field: str) -> list[tuple[Seconds, Any]]:
    """A field's values with their stamps; `field` may have dots, such as "linear.x"."""
    read = [(received.stamp, received.message) for received in recording.messages(topic)]
    return [(stamp, functools.reduce(getattr, field.split("."), message)) for stamp, message in read]
