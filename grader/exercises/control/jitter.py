"""Measure a stream: its latency, its jitter, and the deadlines that it misses."""

import itertools
from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.companions.control_streams import PERIOD, Sensor
from grader.exercise import Exercise
from grader.responses import from_course, matches, same
from grader.variants import Variants
from sim.evidence import Recording, Seconds, since_start
from sim.nanoseconds import EPOCH, SECOND

FLOAT = "std_msgs/msg/Float64"
EXACT, SOON = 1e-4, 0.05  # s

jitter = Exercise("jitter", "How late is late?", seconds=5, companions=[Sensor], seeds=(1, 2),
                  variants=Variants(
    {"limit": (0.01, 0.015, 0.005)},  # s
    texts=("more than {limit} s", "above {limit} s", "latency > {limit}"),
))


class Beat(NamedTuple):
    """A message of the sensor: it arrives when it is sent."""

    arrived: Seconds
    measured: Seconds

    @property
    def latency(self) -> Seconds:
        """From its measurement to its arrival."""
        return self.arrived - self.measured


@jitter.check(2)
def subscribes_to_beats(run: Recording) -> None:
    """The node subscribes to /beat."""
    with hinting("The sensor publishes on /beat."):
        subscribes(run, "/beat", "std_msgs/msg/Header")


@jitter.check(4, after=subscribes_to_beats, hints={
    "It is arrival minus stamp, not the other way round.":
        lambda run, sent, beats: matches(sent, [-beat.latency for beat in beats], EXACT),
    "That is the time of arrival: subtract the stamp from it.":
        lambda run, sent, beats: matches(sent, [EPOCH / SECOND + beat.arrived for beat in beats], EXACT),
    "The latency is now minus the stamp in the header, in seconds.": otherwise,
})
def measures_the_latency(run: Recording) -> list[Beat]:
    """For each message its latency is published on /latency: from when it was measured to when it arrived."""
    beats = _beats(run)
    _require_numbers(run, "/latency", FLOAT, [beat.latency for beat in beats], beats)
    return beats


@jitter.check(5, after=measures_the_latency, hints={
    "Early counts as much as late: use abs(...).":
        lambda run, sent, beats: matches(sent, [gap - PERIOD for gap in _gaps(run)], EXACT),
    "That is the time between two arrivals: how much does it differ from 0.02 s?":
        lambda run, sent, beats: matches(sent, _gaps(run), EXACT),
    "Between stamps it is always 0.02 s, because the sensor measures exactly. What matters to your loop "
    "is when messages arrive, by your own clock.": lambda run, sent, beats: matches(
        sent, [abs(b.measured - a.measured - PERIOD) for a, b in itertools.pairwise(_beats(run))], EXACT
    ),
    "Store when the last message arrived, by your clock; the jitter is abs(now - before - 0.02).": otherwise,
})
def measures_the_jitter(run: Recording, beats: list[Beat]) -> None:
    """For each message but the first, /jitter is how far the time since the previous one is from 0.02 s."""
    _require_numbers(run, "/jitter", FLOAT, [abs(gap - PERIOD) for gap in _gaps(run)], beats[1:])


@jitter.check(3, after=measures_the_latency, hints={
    "You count each message separately: add them up, self.late += 1.":
        lambda run, sent, beats: matches(sent, [int(beat.latency > jitter.drawn.limit) for beat in beats]),
    "Those arrived in time: count only the late ones.": lambda run, sent, beats: matches(
        sent, list(itertools.accumulate(int(beat.latency <= jitter.drawn.limit) for beat in beats))
    ),
    "Count those whose latency is above 0.01 s, from the start on.": otherwise,
})
def counts_missed_deadlines(run: Recording, beats: list[Beat]) -> None:
    """After each message, /late is how many messages so far had a latency of more than 0.01 s."""
    limit = jitter.drawn.limit
    counts: list[float] = list(itertools.accumulate(int(beat.latency > limit) for beat in beats))
    _require_numbers(run, "/late", "std_msgs/msg/Int32", counts, beats)


def _beats(run: Recording) -> list[Beat]:
    rows = from_course(run, "/beat", at_least=10)
    return [Beat(row.stamp, since_start(row.message.stamp)) for row in rows]


def _gaps(run: Recording) -> list[Seconds]:
    return [after.arrived - before.arrived for before, after in itertools.pairwise(_beats(run))]


def _require_numbers(run: Recording, topic: str, type_: str, right: list[float], beats: list[Beat]) -> None:
    """Raise Missed at the first number on a topic that is wrong, or comes long after its message."""
    with hinting(guess="Publish in the callback, each time it is called."):
        rows = publishes(run, topic, type_)
    sent = [row.message.data for row in rows]
    if not len(right) - 1 <= len(sent) <= len(right):  # the last may be under way in the end
        hint = "Publish one number for each message: no more, and none left out."
        raise Missed(f"{len(right)} messages on {topic}", f"{len(sent)}", hint)
    for number, (saw, expected) in enumerate(zip(sent, right, strict=False), 1):
        if not same(saw, expected, EXACT):
            expectation = f"{expected:.4g} as number {number} on {topic}"
            raise Missed(expectation, f"{round(saw, 6):.4g}", about=(sent, beats))
    for row, beat in zip(rows, beats, strict=False):
        if not same(row.stamp, beat.arrived, SOON):
            hint = "Publish in the callback, as each message arrives: later the number is of no use."
            expectation = f"a number on {topic} for the message of {beat.arrived:.3g} s, within {SOON:g} s"
            raise Missed(expectation, f"it comes at {row.stamp:.3g} s", hint)
