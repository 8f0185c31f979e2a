"""The promises of the six systems, and whether a system kept its promise in a play."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from grader.exercises.systems.audit.delays import TICK
from grader.exercises.systems.audit.deliveries import BEGIN, GIVEN, LASTS
from grader.exercises.systems.audit.six_systems import SYSTEMS
from sim.evidence import Call, Message, Recording, Seconds

AT_ONCE, GATE, SLACK = 0.1, 0.6, 0.02  # s: to publish; to open the gate and admit; of messages on their way
FORGOTTEN = "Nothing may get lost: remember what comes too early, and look at it again when the rest comes."
LATE = ("That's right, but late. A fixed wait is too long for most orders, and too short for some: publish "
        "when the last thing that's missing arrives.")  # fmt: skip


class Broken(NamedTuple):
    """The first thing that a system did wrong in a play. hint: "" if nothing more is known."""

    expected: str
    saw: str
    hint: str = ""


class DueOutput(NamedTuple):
    """A text that has to be published from a moment on, at once."""

    stamp: Seconds
    text: str


class SystemPlay(NamedTuple):
    """Everything that a system received and published in a play. topic: that it publishes on."""

    inputs: dict[str, list[Message]]
    calls: list[Call]
    topic: str
    outputs: list[Message]


def broken_promise(run: Recording, name: str, number: int, given: bool = False) -> Broken | None:
    """Return how a system broke its promise in the play of this number; None if it kept it.

    given: the system as it was given, in place of the student's.
    """
    begin = (BEGIN + LASTS * number) * TICK
    return _PROMISES[name](_play(run.during(begin, begin + LASTS * TICK), name, given))


def _play(run: Recording, name: str, given: bool) -> SystemPlay:
    prefix, parts = f"/{GIVEN}/" if given else "/", SYSTEMS[name]
    topic, *answering = parts.shown
    inputs = {
        each: [row for row in run.messages(prefix + each) if row.from_course]
        for each in (*parts.delayed, *answering)
    }
    calls = [each for service in parts.delayed for each in run.calls_of(prefix + service)
             if each.requested_by_course == given]  # fmt: skip
    outputs = [row for row in run.messages(prefix + topic) if row.from_course == given]
    return SystemPlay(inputs, calls, f"/{topic}", outputs)


def _compared(play: SystemPlay, due: Sequence[DueOutput]) -> Broken | None:
    """Return the first difference between what was published and what was due."""
    for number, wanted in enumerate(due):
        between = f"between {wanted.stamp:.2f} and {wanted.stamp + AT_ONCE:.2f} s"
        expected = f"“{wanted.text}” on {play.topic} {between}"
        if number >= len(play.outputs):
            return Broken(expected, "nothing more", FORGOTTEN)
        row = play.outputs[number]
        late, same = row.stamp - wanted.stamp, _text(row) == wanted.text
        if not same or not -1e-6 <= late <= AT_ONCE + SLACK:
            return Broken(expected, f"“{_text(row)}” at {row.stamp:.2f} s", LATE if same and late > 0 else "")
    if len(play.outputs) > len(due):
        row = play.outputs[len(due)]
        return Broken(f"{len(due) or 'no'} message{'s' * (len(due) != 1)} on {play.topic}",
                      f"one more, “{_text(row)}” at {row.stamp:.2f} s")  # fmt: skip
    return None


def _text(row: Message) -> str:
    return str(getattr(row.message, "data", ""))[:60]


def _labels(play: SystemPlay) -> Broken | None:
    """Each parcel gets a label with its color and its weight as soon as both are known."""
    due = []
    for scale, camera in zip(play.inputs["scale"], play.inputs["camera"], strict=True):
        label = f"{_text(camera)} {_text(scale).split()[1]}"
        due.append(DueOutput(max(scale.stamp, camera.stamp), label))
    return _compared(play, due)


def _paths(play: SystemPlay) -> Broken | None:
    """Each path has all of its points, and is published as soon as they and its size are there."""
    points, due = play.inputs["points"], []
    for size in play.inputs["path_sizes"]:
        of_path, points = points[: size.message.data], points[size.message.data :]
        stamp = max(size.stamp, of_path[-1].stamp)
        due.append(DueOutput(stamp, " ".join(map(_text, of_path))))
    return _compared(play, due)


def _one_robot(play: SystemPlay) -> Broken | None:
    """Robots are admitted one after the other, each when the gate is open and the one before has left."""
    free = 0.0
    left = {_text(row): row.stamp for row in play.inputs["departures"]}
    for number, arrival in enumerate(play.inputs["arrivals"]):
        robot, begin = _text(arrival), max(arrival.stamp, free)
        expected = f"“{robot}” on /admitted between {begin:.2f} and {begin + GATE:.2f} s"
        if number >= len(play.outputs):
            return Broken(expected, "nothing more", FORGOTTEN)
        row = play.outputs[number]
        if _text(row) != robot or not -1e-6 <= row.stamp - begin <= GATE:
            return Broken(expected, f"“{_text(row)}” at {row.stamp:.2f} s")
        opened = sum(call.answered is not None and call.answered <= row.stamp + 1e-6 for call in play.calls)
        if opened <= number:
            return Broken(f"an open gate before “{robot}” is admitted", f"it's closed at {row.stamp:.2f} s")
        free = left.get(robot, row.stamp)
    return _compared(play._replace(outputs=play.outputs[len(play.inputs["arrivals"]) :]), [])


def _ride(play: SystemPlay) -> Broken | None:
    """The robot enters the lift that was sent, once, as soon as its doors have opened and it knows which."""
    answered = [call for call in play.calls if call.answered is not None]
    if play.inputs["rides"] and not answered:
        return Broken("a call of /call_lift for the ride", "none")
    due = []
    for call in answered[:1]:
        lift = call.response.message
        doors = [row.stamp for row in play.inputs["open_doors"] if _text(row) == lift]
        due += [DueOutput(max(stamp, call.answered or 0.0), lift) for stamp in doors]
    return _compared(play, due)


def _canceled(play: SystemPlay) -> Broken | None:
    """A job is canceled if a stop follows its order, as soon as its number is known; no other is."""
    due = []
    for order in play.inputs["orders"]:
        stops = [row.stamp for row in play.inputs["stops"] if row.stamp > order.stamp]
        for call in play.calls if stops else ():
            if call.answered is not None:
                due.append(DueOutput(max(stops[0], call.answered), call.response.message))
    return _compared(play, due)


def _stopped(play: SystemPlay) -> Broken | None:
    """The speed is 0 from 0.1 s after something comes close until it is gone."""
    rows = play.inputs["close"]
    for close, gone in zip(rows[::2], rows[1::2], strict=True):
        begin = close.stamp + AT_ONCE + SLACK
        for row in play.outputs:
            if begin <= row.stamp < gone.stamp and row.message.data != 0.0:
                return Broken(f"0 on {play.topic} from {begin:.2f} to {gone.stamp:.2f} s",
                              f"{_text(row)} at {row.stamp:.2f} s")  # fmt: skip
    return None


_PROMISES: dict[str, Callable[[SystemPlay], Broken | None]] = {
    "labeler": _labels, "dock": _one_robot, "collector": _paths, "rider": _ride, "job_starter": _canceled,
    "speed_gate": _stopped,
}  # fmt: skip
