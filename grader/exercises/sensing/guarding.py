"""The project: a safety node between a careless driver and the robot."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed, hinting, keeps_clear, lasts, publishes, subscribes
from grader.companions.blind_drivers import CarelessDriver, CrashingDriver
from grader.companions.radio_link import BadRadio, Radio
from grader.exercise import Exercise, Scenario
from grader.exercises.sensing.evidence import (
    BLOCKED,
    FREE,
    LIDAR,
    OUT,
    RAW,
    STEP,
    Moment,
    Window,
    delays,
    moments_of,
    silences,
)
from grader.worlds.rooms import free_start, long_hall
from sim import Process
from sim.evidence import Pose, Recording

TWIST, SCAN = "geometry_msgs/msg/Twist", "sensor_msgs/msg/LaserScan"
ENOUGH = 5  # moments
SETTLING = 1.0  # seconds to notice that something is old, and to brake
STANDING = 0.02  # m/s


def _remapped(driver: type) -> Process:
    return Process(driver, remappings=[(OUT, RAW)])


guard = Exercise(
    "guard",
    "A guard for the robot",
    scenarios=[
        Scenario(free_start, seconds=40, seed=1, companions=[Radio, _remapped(CarelessDriver)]),
        Scenario(long_hall, seconds=24, seed=2, companions=[BadRadio, _remapped(CrashingDriver)]),
    ],
)


@guard.check(3)
def stands_between(run: Recording) -> None:
    """The node hears /cmd_vel_raw and /lidar, and publishes Twist messages on /cmd_vel."""
    names = "The driver talks on /cmd_vel_raw, the lidar on /lidar, and the robot listens to /cmd_vel."
    with hinting(guess=names):
        subscribes(run, RAW, TWIST)
        subscribes(run, LIDAR, SCAN)
        publishes(run, OUT, TWIST, at_least=10)


@guard.check(4, after=stands_between)
def lets_through(run: Recording) -> list[Moment]:
    """What is harmless passes: while all is well and 1 m is free ahead, the robot does as the driver asks."""
    moments = list(moments_of(run))
    fine = [moment for moment in moments if moment.asked and moment.ahead > FREE]
    wrong = [moment for moment in fine if not _alike(moment.sent, moment.asked)]
    steps = len({int(moment.stamp / STEP) for moment in fine})
    if steps < ENOUGH:
        expected = f"{ENOUGH * STEP:g} s or more in which all is well and {FREE:g} m are free ahead"
        hint = "The driver turns the robot away from walls, and drives on: its commands have to pass."
        saw = f"{steps * STEP:.1f} s: the robot does not get there"
        raise Missed(expected, saw, hint, picture="path")
    if len(wrong) > 0.05 * len(fine):
        first = wrong[0]
        raise Missed(
            f"{_told(first.asked)} at {first.stamp:.3g} s, as the driver asks: {first.ahead:.2f} m are "
            "free ahead",
            _told(first.sent),
            _why_held(run, first),
            picture="topics",
        )
    lasts(run, OUT)
    return moments


@guard.check(5, after=lets_through)
def keeps_from_hitting(run: Recording) -> None:
    """The robot touches nothing, wherever the driver steers it."""
    keeps_clear(
        run,
        "When something is nearer than 0.5 m within 30 degrees of straight ahead, linear.x becomes 0. "
        "These rays lie at both ends of msg.ranges. Fewer are not enough: the robot is 20 cm wide.",
    )


@guard.check(2, after=lets_through)
def lets_turn(run: Recording, moments: list[Moment]) -> None:
    """Before a wall it takes away the speed ahead only: the driver can still turn the robot."""
    for moment in moments:
        if not (moment.asked and moment.asked[1] and moment.ahead < BLOCKED):
            continue
        turn = moment.asked[1]
        if not moment.sent or not abs(moment.sent[1] - turn) <= 0.05:  # so that NaN doesn't pass
            raise Missed(
                f"a turn of {turn:g} rad/s at {moment.stamp:.3g} s, as the driver asks",
                _told(moment.sent),
                "Set linear.x to 0, and leave angular.z as it is: a turn on the spot hits nothing.",
            )


@guard.check(3, after=lets_through)
def stops_without_driver(run: Recording) -> None:
    """When the driver falls silent, the robot stands within 1 s."""
    hint = (
        "Remember when the last command came, and look at its age in the timer: older than 0.3 s, and "
        "zeros go out. Else the timer repeats the last command for ever."
    )
    _stands(run, silences(run, RAW), "the driver's last command", hint)


@guard.check(3, after=lets_through)
def stops_without_scans(run: Recording) -> None:
    """When no scan comes any more, the robot stands within 1 s."""
    hint = (
        "No news is bad news. Remember when the last scan came, and look at its age in the timer, not in "
        "the scan's callback: that one isn't called any more."
    )
    _stands(run, silences(run, LIDAR), "the last scan", hint)


@guard.check(2, after=(lets_through, stops_without_scans))
def stops_with_late_scans(run: Recording) -> None:
    """When the scans come 1 s late, the robot stands within 1 s."""
    hint = (
        "Scans do come, 20 in a second, but they are old. The age is not the time since the scan came, "
        "but the time since it was measured: now minus msg.header.stamp."
    )
    _stands(run, delays(run), "the last scan that came in time", hint, unsafe=False)


def _stands(run: Recording, windows: list[Window], what: str, hint: str, *, unsafe: bool = True) -> None:
    """Raises Missed where the robot still moves, 1 s after a window has begun."""
    for begin, end in windows:
        path = run.during(begin + SETTLING, end + 1e-6).path
        speeds = [(_speed(before, after), after.stamp) for before, after in itertools.pairwise(path)]
        speed, stamp = max(speeds, default=(0.0, 0.0))
        if speed > STANDING:
            raise Missed(
                f"the robot standing, {SETTLING:g} s after {what} (at {begin:.3g} s)",
                f"it drives at {speed:.2f} m/s at {stamp:.3g} s",
                hint,
                picture="topics",
                unsafe=unsafe,
            )


def _speed(before: Pose, after: Pose) -> float:
    return math.dist(before[1:3], after[1:3]) / (after.stamp - before.stamp)


def _told(command: tuple[float, float] | None) -> str:
    if command is None:
        return "no command for 0.3 s"
    return f"linear.x {command[0]:.3g}, angular.z {command[1]:.3g}"


def _alike(one: tuple[float, float] | None, other: tuple[float, float] | None) -> bool:
    return bool(one and other) and all(abs(a - b) < 0.05 for a, b in zip(one, other, strict=True))


def _why_held(run: Recording, moment: Moment) -> str:
    """The usual reasons for holding a command back."""
    faults = [*silences(run, RAW), *silences(run, LIDAR), *delays(run)]
    if any(end < moment.stamp for _, end in faults):
        return "There was a fault before, but now all is well again: then the commands should pass again."
    if moment.sent is None:
        return "Publish from a timer, 20 times a second: without commands the robot stops after 0.5 s."
    if moment.sent == (0.0, 0.0):
        return (
            "Zeros, although all is well. Print what is_well() returns: it needs a `return`, and ages are in "
            "seconds. If that is True, something beside the robot may stop it: look 30 degrees to each side."
        )
    return "Copy the driver's linear.x and angular.z as they are."
