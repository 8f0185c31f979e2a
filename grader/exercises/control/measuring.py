"""An exercise on measuring a stream: its latency, its jitter, and the deadlines it misses."""

from __future__ import annotations

import itertools

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.control.partners import PERIOD, Sensor
from sim.evidence import Recording, Seconds, since_start
from sim.nanoseconds import EPOCH, SECOND

FLOAT, COUNT = "std_msgs/msg/Float64", "std_msgs/msg/Int32"
ALLOWED = 0.01  # s of latency
EXACT, SOON = 1e-4, 0.05  # s

jitter = Exercise("jitter", "How late is late?", seconds=5, companions=[Sensor], seeds=(1, 2))
Beat = tuple[Seconds, Seconds]  # when it arrived, and when it was measured


@jitter.check(2)
def listens(run: Recording) -> None:
    """The node subscribes to /beat."""
    with hinting("The sensor publishes on /beat."):
        subscribes(run, "/beat", "std_msgs/msg/Header")


@jitter.check(4, after=listens)
def measures_the_latency(run: Recording) -> list[Beat]:
    """With each message its latency is on /latency: from when it was measured to when it arrived."""
    beats = _beats(run)
    said, true = _said(run, "/latency", FLOAT), [arrived - measured for arrived, measured in beats]
    hints = {
        tuple(-late for late in true): "Arrival minus stamp, and not the other way round.",
        tuple(EPOCH / SECOND + arrived for arrived, _ in beats): "That is the time of day: "
        "take the stamp away from it.",
    }
    guess = "The latency is now minus the stamp in the header, in seconds."
    _compare("/latency", said, true, beats, hints, guess)
    return beats


@jitter.check(5, after=measures_the_latency)
def measures_the_jitter(run: Recording, beats: list[Beat]) -> None:
    """With each message but the first, /jitter says by how much the time since the last is not 0.02 s."""
    gaps = [b[0] - a[0] for a, b in itertools.pairwise(beats)]
    true = [abs(one - PERIOD) for one in gaps]
    stamps = [abs(b[1] - a[1] - PERIOD) for a, b in itertools.pairwise(beats)]
    hints = {
        tuple(one - PERIOD for one in gaps): "Early counts as much as late: take abs(...) of it.",
        tuple(gaps): "That is the time between two arrivals: how much does it differ from 0.02 s?",
        tuple(stamps): "Between the stamps it is always 0.02 s, for the sensor measures exactly. What your "
        "loop feels is when messages arrive: by your own clock.",
    }
    guess = "Remember when the last message arrived, by your clock; abs(now - before - 0.02)."
    _compare("/jitter", _said(run, "/jitter", FLOAT), true, beats[1:], hints, guess)


@jitter.check(3, after=measures_the_latency)
def counts_missed_deadlines(run: Recording, beats: list[Beat]) -> None:
    """After each message /late says how many came with a latency of more than 0.01 s."""
    late = [arrived - measured > ALLOWED for arrived, measured in beats]
    true = list(itertools.accumulate(map(int, late)))
    hints = {
        tuple(map(int, late)): "Each count is for one message alone: add them up, self.late += 1.",
        tuple(len(late[: n + 1]) - count for n, count in enumerate(true)): "Those came in time.",
    }
    guess = "Count those whose latency is above 0.01 s, from the start on."
    _compare("/late", _said(run, "/late", COUNT), true, beats, hints, guess)


def _beats(run: Recording) -> list[Beat]:
    """Arrival and measurement of each of our messages: nothing lies between, they arrive as they are sent."""
    ours = [heard for heard in run.messages("/beat") if heard.from_course]
    if len(ours) < 10:
        raise no_data(run, "messages on /beat", f"{len(ours)}", run.graph.publishers("/beat"))
    return [(heard.stamp, since_start(heard.message.stamp)) for heard in ours]


def _said(run: Recording, topic: str, type_: str) -> list[tuple[Seconds, float]]:
    with hinting(guess="Publish in the callback, each time it is called."):
        return [(heard.stamp, heard.message.data) for heard in publishes(run, topic, type_)]


def _compare(
    topic: str,
    heard: list[tuple[Seconds, float]],
    true: list[float],
    beats: list[Beat],
    hints: dict[tuple[float, ...], str],
    guess: str,
) -> None:
    """Raises Missed at the first number that is wrong, with the hint for numbers that are all alike.

    And at the first that comes long after its message. heard: when each number was said, and which.
    """
    said = [value for _, value in heard]
    if not len(true) - 1 <= len(said) <= len(true):  # the last may be under way in the end
        hint = "One number for each message: no more, and none left out."
        raise Missed(f"{len(true)} messages on {topic}", f"{len(said)}", hint)
    for number, (one, right) in enumerate(zip(said, true, strict=False), 1):
        if not abs(one - right) < EXACT:
            hint = _alike(said, hints) or guess
            raise Missed(f"{right:.4g} as number {number} on {topic}", f"{round(one, 6):.4g}", hint)
    for (stamp, _), (arrived, _) in zip(heard, beats, strict=False):
        if not abs(stamp - arrived) < SOON:
            hint = "Publish in the callback, as each message comes: later the number is of no use."
            expected = f"a number on {topic} for the message of {arrived:.3g} s, within {SOON:g} s"
            raise Missed(expected, f"it comes at {stamp:.3g} s", hint)


def _alike(said: list[float], hints: dict[tuple[float, ...], str]) -> str:
    for wrong, hint in hints.items():
        if all(abs(a - b) < EXACT for a, b in zip(said, wrong, strict=False)):
            return hint
    return ""
