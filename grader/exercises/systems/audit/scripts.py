"""The messages that each system receives in a play, and the delays with which the judge tries it."""

from __future__ import annotations

import random
from typing import Any, NamedTuple

from std_msgs.msg import Bool, Float64, Int32, String

from grader.exercises.systems.audit.delays import LONGEST, STEP
from grader.exercises.systems.audit.six_systems import SYSTEMS

COLORS, ROBOTS = ("red", "blue", "green", "white", "black"), ("anna", "bert", "carl", "dora", "emil")
LIFTS = ((0, 1), (0, 1), (1, 0), (1, 0), (0, 1))  # of each play: the one that is sent, and another one


class Delivery(NamedTuple):
    """A message, and when it is published without a delay, in ticks after the start of a play."""

    tick: int
    topic: str
    message: Any


class PlayScript(NamedTuple):
    """The messages that a system receives in a play.

    response: the text in the responses of its service. other: a lift whose doors open for other robots.
    """

    deliveries: list[Delivery]
    response: str = ""
    other: str = ""


def script_of(name: str, number: int, seed: int) -> PlayScript:
    """Return what a system receives in the play of this number."""
    draw = random.Random(f"{name} {number} {seed}")
    return _SCRIPTS[name](draw, number + seed)


def _labeler(draw: random.Random, number: int) -> PlayScript:
    parcels = [100 * (number % 1000) + each for each in draw.sample(range(100), 6)]
    weights = draw.sample(range(11, 99), 6)
    found = []
    for index, (parcel, weight) in enumerate(zip(parcels, weights, strict=True)):
        found.append(Delivery(10 + 20 * index, "scale", String(data=f"{parcel} {weight / 10:.1f}")))
        found.append(Delivery(12 + 20 * index, "camera", String(data=f"{parcel} {draw.choice(COLORS)}")))
    return PlayScript(found)


def _dock(draw: random.Random, _: int) -> PlayScript:
    robots = draw.sample(ROBOTS, 2)
    ticks = zip((10, 34), robots, strict=True)
    return PlayScript([Delivery(tick, "arrivals", String(data=robot)) for tick, robot in ticks])


def _collector(draw: random.Random, _: int) -> PlayScript:
    points = [String(data=f"{draw.randint(0, 99)},{number}") for number in draw.sample(range(100), 5)]
    ticks = zip((10, 20, 30, 90, 100), points, strict=True)
    sizes = [Delivery(42, "path_sizes", Int32(data=3)), Delivery(112, "path_sizes", Int32(data=2))]
    return PlayScript([*(Delivery(tick, "points", point) for tick, point in ticks), *sizes])


def _rider(draw: random.Random, number: int) -> PlayScript:
    lift, other = ("AB"[index] for index in LIFTS[number % len(LIFTS)])
    return PlayScript([Delivery(10, "rides", String(data=str(draw.randint(1, 9))))], lift, other)


def _job_starter(draw: random.Random, number: int) -> PlayScript:
    job, found = str(draw.randint(100, 999)), [Delivery(10, "orders", String(data="sweep"))]
    if number % 2 == 0:
        found.append(Delivery(44, "stops", String(data="stop")))
    return PlayScript(found, job)


def _speed_gate(draw: random.Random, _: int) -> PlayScript:
    speeds = [draw.randint(10, 50) / 100 for _ in range(3)]
    found = [Delivery(tick, "joystick", Float64(data=speed)) for tick, speed in
             zip((10, 60, 120), speeds, strict=True)]  # fmt: skip
    close = [Delivery(32, "close", Bool(data=True)), Delivery(92, "close", Bool(data=False))]
    return PlayScript([*found, *close])


_SCRIPTS = {"labeler": _labeler, "dock": _dock, "collector": _collector, "rider": _rider,
            "job_starter": _job_starter, "speed_gate": _speed_gate}  # fmt: skip
LATE = {"labeler": ("camera", 20), "dock": ("open_gate", 15), "collector": ("points", 15),
        "rider": ("call_lift", 25)}  # fmt: skip


def draw_delays(name: str, number: int, seed: int) -> dict[str, list[int]]:
    """Return the delays of the play of this number: in odd ones something is late on purpose."""
    draw = random.Random(f"delays {name} {number} {seed}")
    if number % 2 and name in LATE:
        late, least = LATE[name]
        return {late: [draw.randrange(least, LONGEST + 1, STEP)]}
    return {each: [draw.randrange(0, LONGEST + 1, STEP) for _ in range(6)] for each in SYSTEMS[name].delayed}
