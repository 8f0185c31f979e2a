"""What control could know at each moment of a run, from what our perception said: the evidence for `gate`."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from grader.exercises.delivery.floor import flat
from grader.exercises.delivery.partners import PEOPLE, POSE
from sim.evidence import Message, Recording, Seconds, since_start

STEP = 0.05  # s
OLD, NEAR, WIDE = 0.5, 1.5, 2.5  # s; m: stands, drives slowly
ABOUT = 0.05  # m; what is nearer to a limit is on neither side


class Moment(NamedTuple):
    """The age of the older news (s), why it is old, and how far the nearest person was said to be (m)."""

    stamp: Seconds
    age: Seconds
    why: str
    near: float


class Span(NamedTuple):
    """A time in which one thing held all along, and what it was, in words."""

    begin: Seconds
    end: Seconds
    why: str


def moments(run: Recording) -> list[Moment]:
    """From the first news of both kinds on."""
    said = {topic: [one for one in run.messages(topic) if one.from_course] for topic in (POSE, PEOPLE)}
    if not all(said.values()):
        return []
    begin = max(heard[0].stamp for heard in said.values())
    return [_moment(said, begin + index * STEP) for index in range(int((run.ended.stamp - begin) / STEP))]


def _moment(said: dict[str, list[Message]], now: Seconds) -> Moment:
    pose, people = (_last(said[topic], now) for topic in (POSE, PEOPLE))
    ages = {POSE: now - since_start(pose.message.header.stamp)}
    ages[PEOPLE] = now - since_start(people.message.header.stamp)
    here = flat(pose.message.pose)[:2]
    near = min((math.dist(here, flat(one)[:2]) for one in people.message.poses), default=math.inf)
    why = "there was no news"
    if now - pose.stamp < OLD:
        why = f"nothing came on {PEOPLE}" if now - people.stamp > OLD else "the stamps of all news were old"
    return Moment(now, max(ages.values()), why, near)


def _last(said: list[Message], now: Seconds) -> Message:
    return said[max(0, bisect.bisect_right(said, now + 1e-6, key=lambda heard: heard.stamp) - 1)]


def old(moment: Moment) -> str:
    """Why the news is too old, or nothing."""
    return moment.why if moment.age > OLD else ""


def close(moment: Moment) -> str:
    """That somebody is near, or nothing."""
    return "somebody was within 1.5 m" if moment.near < NEAR - ABOUT and moment.age < OLD else ""


def about(moment: Moment) -> str:
    """That somebody is farther than that, and not far, or nothing."""
    inside = NEAR + ABOUT < moment.near < WIDE - ABOUT and moment.age < OLD
    return "somebody was within 2.5 m" if inside else ""


def allowed(moment: Moment) -> str:
    """That nothing speaks against driving, or nothing."""
    return "nothing spoke against it" if moment.near > NEAR + ABOUT and moment.age < OLD - 0.1 else ""


def spans(run: Recording, held: Callable[[Moment], str]) -> Iterator[Span]:
    """The times in which one of the functions above says the same."""
    begin, why = 0.0, ""
    known = moments(run)
    for moment in [*known, Moment(run.ended.stamp, 0.0, "", math.inf)]:
        says = held(moment) if moment.stamp < run.ended.stamp else ""
        if says != why:
            if why:
                yield Span(begin, moment.stamp, why)
            begin, why = moment.stamp, says
