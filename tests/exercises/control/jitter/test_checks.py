"""The checks of `jitter` at their edges: tolerances, times, numbers of messages, and the hint for each mistake."""

import itertools

import pytest
from builtin_interfaces.msg import Time
from std_msgs.msg import Float64, Header, Int32

from grader.checks import judge
from grader.exercises.control import jitter
from sim.nanoseconds import EPOCH, SECOND
from tests.sim.recordings import exchange

LATE = [0.002, 0.004, 0.012, 0.0101, 0.0099, 0.003, 0.015, 0.002, 0.001, 0.006, 0.004, 0.013]  # s
MEASURED = [0.02 * (n + 1) for n in range(12)]
ARRIVED = [measured + late for measured, late in zip(MEASURED, LATE, strict=True)]
GAPS = [after - before for before, after in itertools.pairwise(ARRIVED)]
JITTER = [abs(gap - 0.02) for gap in GAPS]
COUNTS = [0, 0, 1, 2, 2, 2, 3, 3, 3, 3, 3, 4]
TOPICS = {
    "/latency": (Float64, ARRIVED, LATE),
    "/jitter": (Float64, ARRIVED[1:], JITTER),
    "/late": (Int32, ARRIVED, COUNTS),
}
CHECKS = dict(zip(TOPICS, ("measures_the_latency", "measures_the_jitter", "counts_missed_deadlines"), strict=True))


def beat(measured):
    stamp = EPOCH + round(measured * SECOND)
    return Header(stamp=Time(sec=stamp // SECOND, nanosec=stamp % SECOND))


def verdict(topic, values, stamps=None, count=12):
    """That of a topic's check where these values are on the topic, and what is right on the other two."""
    streams = [("/beat", [(a, beat(m)) for a, m in zip(ARRIVED, MEASURED, strict=True)][:count], True)]
    for name, (kind, times, right) in TOPICS.items():
        times, data = (stamps or times, values) if name == topic else (times, right)
        streams.append((name, [(t, kind(data=d)) for t, d in zip(times, data, strict=False)], False))
    verdicts = judge(jitter.checks, exchange(*streams, seconds=5.0))
    return next(verdict for verdict in verdicts if verdict.name == CHECKS[topic])


def missed(topic, values, *arguments):
    found = verdict(topic, values, *arguments)
    assert found.status == "failed"
    return found.expected, found.saw, found.hint


def changed(topic, index, value):
    values = list(TOPICS[topic][2])
    values[index] = value
    return values


@pytest.mark.parametrize("topic", TOPICS)
def test_what_is_right_passes_and_the_last_message_may_be_missing(topic):
    right = TOPICS[topic][2]
    assert verdict(topic, right).status == "passed"
    assert verdict(topic, right[:-1]).status == "passed"


@pytest.mark.parametrize("topic", TOPICS)
def test_a_number_is_missing_or_too_many(topic):
    right, stamps = TOPICS[topic][2], TOPICS[topic][1]
    hint = "Publish one number for each message: no more, and none left out."
    few, many = f"{len(right) - 2}", f"{len(right) + 1}"
    assert missed(topic, right[:-2]) == (f"{len(right)} messages on {topic}", few, hint)
    assert missed(topic, [*right, right[-1]], [*stamps, 0.3]) == (f"{len(right)} messages on {topic}", many, hint)


@pytest.mark.parametrize("topic", ["/latency", "/jitter"])
def test_a_tenth_of_a_millisecond_is_exact_enough(topic):
    right = TOPICS[topic][2]
    for sign in (1, -1):
        assert verdict(topic, changed(topic, 3, right[3] + sign * 0.95e-4)).status == "passed"
        wrong = right[3] + sign * 1.1e-4
        expected, saw, _ = missed(topic, changed(topic, 3, wrong))
        assert (expected, saw) == (f"{right[3]:.4g} as number 4 on {topic}", f"{round(wrong, 6):.4g}")


@pytest.mark.parametrize("topic", ["/latency", "/jitter"])
def test_nan_is_wrong(topic):
    assert missed(topic, changed(topic, 0, float("nan")))[1] == "nan"


@pytest.mark.parametrize("topic", TOPICS)
def test_a_number_may_take_a_twentieth_of_a_second_and_no_longer(topic):
    _, stamps, right = TOPICS[topic]
    last = stamps[-1]
    assert verdict(topic, right, [*stamps[:-1], last + 0.049]).status == "passed"
    assert missed(topic, right, [*stamps[:-1], last + 0.051]) == (
        f"a number on {topic} for the message of {last:.3g} s, within 0.05 s",
        f"it comes at {last + 0.051:.3g} s",
        "Publish in the callback, as each message arrives: later the number is of no use.",
    )


def test_ten_messages_are_enough_and_nine_are_none_of_the_students_fault():
    assert verdict("/latency", LATE[:10], None, 10).status == "passed"
    found = verdict("/latency", LATE[:9], None, 9)
    assert found.status == "broken"
    assert "messages on /beat" in found.alarm


@pytest.mark.parametrize(
    ("topic", "values", "hint"),
    [
        ("/latency", [-late for late in LATE], "It is arrival minus stamp, not the other way round."),
        (
            "/latency",
            [EPOCH / SECOND + arrived for arrived in ARRIVED],
            "That is the time of arrival: subtract the stamp from it.",
        ),
        ("/latency", MEASURED, "The latency is now minus the stamp in the header, in seconds."),
        (
            "/latency",
            [*[-late for late in LATE[:-1]], 0.0],
            "The latency is now minus the stamp in the header, in seconds.",
        ),
        ("/jitter", [gap - 0.02 for gap in GAPS], "Early counts as much as late: use abs(...)."),
        ("/jitter", GAPS, "That is the time between two arrivals: how much does it differ from 0.02 s?"),
        (
            "/jitter",
            [0.0] * 11,
            "Between stamps it is always 0.02 s, because the sensor measures exactly. What matters to your loop is "
            "when messages arrive, by your own clock.",
        ),
        (
            "/jitter",
            [0.01] * 11,
            "Store when the last message arrived, by your clock; the jitter is abs(now - before - 0.02).",
        ),
        (
            "/late",
            [int(late > 0.01) for late in LATE],
            "You count each message separately: add them up, self.late += 1.",
        ),
        ("/late", [n + 1 - count for n, count in enumerate(COUNTS)], "Those arrived in time: count only the late ones."),
        ("/late", [count + 1 for count in COUNTS], "Count those whose latency is above 0.01 s, from the start on."),
        ("/late", [0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 3], "Count those whose latency is above 0.01 s, from the start on."),
    ],
)
def test_each_wrong_formula_has_a_hint_of_its_own(topic, values, hint):
    assert missed(topic, values)[2] == hint
