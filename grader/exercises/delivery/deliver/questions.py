"""Questions about a shift in a warehouse, for the robot's author: what happened and when, not why."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from grader.checks.motion import traveled
from grader.checks.people import nearest_person
from grader.checks.shift import Job, Shift, shift
from sim.evidence import Pose, Recording, Seconds

MOST, LEAST = 5, 2
MOVES, TURNS = 0.02, 0.05  # m/s and rad/s; a robot that is slower in both stands
DRIVES = 0.1  # m/s; a robot that is slower comes to a stand
LONG = 2.5  # s; to take a load or to hand it over, and to see where to go then, takes less
NEAR = 2.0  # m from the robot's middle to a person
ROUND, MORE = 1.5, 2.0  # times the straight line, and m more than it
WAY = 5.0  # m; a robot that drove less has gone nowhere


class Question(NamedTuple):
    """A question, and the time that it is about (s): `recording.during(0, end).replay()` opens there."""

    begin: Seconds
    end: Seconds
    text: str


def questions(recording: Recording) -> list[Question]:
    """At most five questions on a shift, in the order of time; after a minute of it two or more.

    Raises ValueError for a run without a warehouse.
    """
    done = shift(recording)
    pauses = list(_pauses(recording, done))
    found = [
        _near_a_person(recording),
        _stood(recording, (pause for pause in pauses if pause.aboard), LONG),
        _given_up(done),
        _battery(recording, done),
        _stood(recording, (pause for pause in pauses if not pause.aboard), LONG),
        _went_round(recording, done),
        _took_longest(done),
    ]
    asked = [question for question in found if question][:MOST]
    if len(asked) < LEAST:
        more = _stood(recording, pauses, 0.0), _left(done, recording.stamp), _in_vain(done, recording.stamp)
        asked += [question for question in more if question and question not in asked]
    return sorted(asked)


def _near_a_person(recording: Recording) -> Question | None:
    """The first touch, or else the moment at which the robot drove nearest to a person."""
    touch = next((contact.stamp for contact in recording.contacts if contact.what == "person"), None)
    if touch is not None:
        text = "which program should have kept it standing still, and what did that program know?"
        return Question(touch, touch, f"At {touch:.1f} s it touched a person: {text}")
    near = nearest_person(recording, DRIVES)
    if near is None or near.away > NEAR:
        return None
    saw = f"At {near.stamp:.1f} s it drove at {near.speed:.2f} m/s, {near.away:.1f} m from a person"
    return Question(near.stamp, near.stamp, f"{saw}: what did it know about this person?")


class _QuestionPause(NamedTuple):
    """A time in which the robot stood though there was this order: with its load aboard, or not yet."""

    begin: Seconds
    end: Seconds
    job: Job
    aboard: bool


def _pauses(recording: Recording, done: Shift) -> Iterator[_QuestionPause]:
    """All of them, however short. An order waits for a robot that carries nothing and doesn't charge."""
    stands, last = list(_stands(recording.path)), recording.stamp
    busy = [(charge.begin, charge.end) for charge in _charges(done)]
    for job in done.jobs:
        over = last if job.over is None else job.over
        if job.picked_up is not None:
            busy.append((job.picked_up, over))
            for begin, end in _inside(stands, job.picked_up, over):
                yield _QuestionPause(begin, end, job, True)
    for job in done.jobs:
        fetched = job.picked_up or job.over or last
        for begin, end in _inside(stands, job.requested, fetched):
            if not any(first <= (begin + end) / 2 < then for first, then in busy):
                yield _QuestionPause(begin, end, job, False)


def _stands(path: list[Pose]) -> Iterator[tuple[Seconds, Seconds]]:
    """When the robot stands, from when to when (s)."""
    for still, pairs in itertools.groupby(itertools.pairwise(path), key=_is_still):
        if still:
            steps = list(pairs)
            yield steps[0][0].stamp, steps[-1][1].stamp


def _is_still(pair: tuple[Pose, Pose]) -> bool:
    before, now = pair
    lasts, turned = now.stamp - before.stamp, abs(math.remainder(now.yaw - before.yaw, math.tau))
    return _apart(before, now) < MOVES * lasts and turned < TURNS * lasts


def _inside(
    spans: Iterable[tuple[Seconds, Seconds]], begin: Seconds, end: Seconds
) -> Iterator[tuple[Seconds, Seconds]]:
    """The parts of the spans between two moments."""
    parts = ((max(first, begin), min(last, end)) for first, last in spans)
    return (part for part in parts if part[0] < part[1])


def _stood(recording: Recording, pauses: Iterable[_QuestionPause], least: Seconds) -> Question | None:
    """The longest of the pauses, if it took so long; where several orders waited, one that was fetched."""
    longest = max(pauses, key=lambda one: (one.end - one.begin, one.job.picked_up is not None), default=None)
    if longest is None or longest.end - longest.begin < least:
        return None
    begin, end, job, aboard = longest
    load = f"with order {job.id} aboard" if aboard else f"while order {job.id} waited"
    saw = f"From {begin:.1f} to {end:.1f} s it stood {load}, {_place(recording, begin)}"
    return Question(begin, end, f"{saw}: what was it waiting for?")


def _place(recording: Recording, stamp: Seconds) -> str:
    """Return how far the robot was then from what has a name in the picture."""
    here = recording.pose_at(stamp)[1:3]
    places = recording.world.places() if recording.world else {}
    away, name = min((math.dist(here, there[:2]), name) for name, there in places.items())
    return f"{away:.1f} m from {name}" if "_" in name else f"{away:.1f} m from the {name}"


def _given_up(done: Shift) -> Question | None:
    """The first order that expired, or else the first one that was canceled when it was aboard."""
    for job in done.jobs:
        if job.status == "expired" and job.over is not None:
            why = "it was never fetched: which rule skipped it, and was that right?"
            if job.picked_up is not None:
                why = f"it was aboard from {job.picked_up:.1f} s on: where did the time go?"
            saw = f"Order {job.id} came at {job.requested:.1f} s and expired at {job.over:.1f} s"
            return Question(job.requested, job.over, f"{saw}; {why}")
    for job in done.jobs:
        if job.status == "canceled" and job.over is not None and job.picked_up is not None:
            saw = f"At {job.over:.1f} s order {job.id} was canceled, and it was aboard"
            return Question(job.over, job.over, f"{saw}: what did the robot do then, and was that right?")
    return None


class _Charge(NamedTuple):
    """A time in which the battery was filled, from `low` to `high` (0 to 1)."""

    begin: Seconds
    low: float
    end: Seconds
    high: float


def _charges(done: Shift) -> Iterator[_Charge]:
    pairs = itertools.pairwise(done.battery)
    for fills, steps in itertools.groupby(pairs, key=lambda pair: pair[1][1] > pair[0][1]):
        if fills:
            known = list(steps)
            yield _Charge(*known[0][0], *known[-1][1])


def _battery(recording: Recording, done: Shift) -> Question | None:
    """Return when it was empty, or else the longest time of charging while an order waited."""
    empty = next((stamp for stamp, share in done.battery if share <= 0.0), None)
    if empty is not None:
        saw = f"At {empty:.1f} s the battery was empty, {_place(recording, empty)}"
        return Question(empty, empty, f"{saw}: when should the robot have turned back?")
    found = [charge for charge in _charges(done) if _waited(done, charge)]
    if not found:
        return None
    longest = max(found, key=lambda charge: charge.end - charge.begin)
    begin, low, end, high = longest
    count = len(_waited(done, longest))
    orders = "an order" if count == 1 else f"{count} orders"
    saw = f"From {begin:.1f} to {end:.1f} s it charged, from {low:.0%} to {high:.0%}, while {orders} waited"
    return Question(begin, end, f"{saw}: why then, and why so long?")


def _waited(done: Shift, charge: _Charge) -> list[Job]:
    """The orders that waited for the end of it."""
    waited = (job for job in done.jobs if job.requested + LONG < charge.end)
    return [job for job in waited if charge.end <= (job.picked_up or job.over or math.inf)]


def _went_round(recording: Recording, done: Shift) -> Question | None:
    """The delivery whose way was longer than the straight line by most."""
    ways = []
    for job in done.delivered:
        begin, end = job.picked_up or job.requested, job.over or recording.stamp
        line = _apart(recording.pose_at(begin), recording.pose_at(end))
        way = traveled(recording.during(begin, end))
        ways.append((way - line, way, line, begin, end, job.id))
    more, way, line, begin, end, order = max(ways, default=(0.0,) * 6)
    if more < MORE or way < ROUND * line:
        return None
    saw = f"From {begin:.1f} to {end:.1f} s it drove {way:.1f} m with order {order} aboard"
    why = f"the straight line is {line:.1f} m: what was in between, and was there a shorter way?"
    return Question(begin, end, f"{saw}; {why}")


def _took_longest(done: Shift) -> Question | None:
    """Of the orders that were delivered, the one that took longest."""
    took = [(job.over - job.requested, job) for job in done.delivered if job.over is not None]
    if not took:
        return None
    lasted, job = max(took)
    more = "" if len(took) == 1 else ", longer than any other"
    saw = f"Order {job.id} came at {job.requested:.1f} s and took {lasted:.1f} s{more}"
    return Question(job.requested, job.requested + lasted, f"{saw}: how much of that was driving?")


def _left(done: Shift, last: Seconds) -> Question | None:
    """The oldest order that still waits at the end, where none was delivered."""
    left = [job for job in done.jobs if job.status == "waiting"]
    if done.delivered or not left:
        return None
    saw = f"Order {left[0].id} came at {left[0].requested:.1f} s and still waited at {last:.1f} s"
    return Question(left[0].requested, last, f"{saw}: what kept the robot from fetching it?")


def _in_vain(done: Shift, last: Seconds) -> Question | None:
    """A long way without a delivery."""
    if done.delivered or done.way < WAY:
        return None
    return Question(0.0, last, f"It drove {done.way:.0f} m and delivered nothing: where was it trying to go?")


def _apart(one: Pose, other: Pose) -> float:
    """Return how far two poses are from each other, m."""
    return math.dist(one[1:3], other[1:3])
