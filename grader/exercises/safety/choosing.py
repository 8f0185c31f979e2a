"""An exercise on a velocity mux: two drivers, one robot."""

from __future__ import annotations

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.safety.moving import OUT, TWIST, alike, last, must_stand, ours, speeds, told
from grader.exercises.safety.partners import JOY, NAV, Drivers
from sim.evidence import Message, Recording, Seconds

FRESH, OLD, BRAKING = 0.42, 0.68, 1.0  # s: sure to be younger, and older, than the time-out; to stand
STEP, STEADY, BEGIN = 0.1, 0.25, 5  # s, s, steps
ZERO = "A 0 of the joystick is a command, too: ask how old it is, not how fast."
FIRST = "Look at the joystick first: while it is young, the navigator has to wait."

mux = Exercise("mux", "Two drivers, one robot", world="yard", seconds=15, companions=[Drivers], seeds=(1, 2))


class Moment(NamedTuple):
    """What each driver wants, and what went out. A driver is None where it is old, or about to change."""

    stamp: Seconds
    joy: tuple[float, float] | None
    nav: tuple[float, float] | None
    joy_is_old: bool
    sent: tuple[float, float] | None


@mux.check(3)
def stands_between(run: Recording) -> None:
    """The node hears /cmd_vel_joy and /cmd_vel_nav, and publishes Twist messages on /cmd_vel."""
    with hinting(guess="Two subscriptions, one for each driver, and a publisher for the robot."):
        for topic in (JOY, NAV):
            subscribes(run, topic, TWIST)
        publishes(run, OUT, TWIST, at_least=10)


@mux.check(5, after=stands_between)
def passes_the_navigator(run: Recording) -> None:
    """Before anybody touches the joystick, the robot does as the navigator says."""
    first = ours(run, JOY)[0].stamp
    moments = [one for one in _moments(run) if one.nav and one.stamp < first]
    hint = "Remember the navigator's last command and when it came; younger than 0.5 s, and it goes out."
    _compare(run, moments, NAV, hint)


@mux.check(6, after=passes_the_navigator)
def joystick_wins(run: Recording) -> None:
    """While the joystick speaks, it alone counts, also where it says 0."""
    moments = [one for one in _moments(run) if one.joy]
    stops = [one for one in moments if one.joy == (0.0, 0.0)]
    _compare(run, [one for one in moments if one not in stops], JOY, FIRST)
    _compare(run, stops, JOY, ZERO)


@mux.check(3, after=joystick_wins)
def gives_back(run: Recording) -> None:
    """When the joystick has said nothing for 0.5 s, the navigator drives again."""
    first = ours(run, JOY)[0].stamp
    moments = [one for one in _moments(run) if one.nav and one.joy_is_old and one.stamp > first]
    hint = "The joystick's last command never gets old: compare the time since it came with 0.5 s."
    _compare(run, moments, NAV, hint)


@mux.check(5, after=passes_the_navigator)
def stands_without_both(run: Recording) -> None:
    """When both have fallen silent, the robot stands within 1 s, until one of them speaks again."""
    said = sorted(heard.stamp for topic in (JOY, NAV) for heard in ours(run, topic))
    hint = (
        "Commands get old, those of both drivers. Look at their ages each time, by the clock, and send an "
        "empty Twist where none is younger than 0.5 s."
    )
    for begin, end in zip(said, [*said[1:], run.ended.stamp], strict=True):
        if end - begin > BRAKING:
            why = f"{BRAKING:g} s after the last command, at {begin:.3g} s"
            must_stand(run, begin + BRAKING, end, why, hint)


def _compare(run: Recording, moments: list[Moment], topic: str, hint: str) -> None:
    """Raises Missed at the first moment at which the robot was told something else than by this driver."""
    if not moments:
        raise no_data(run, f"commands on {topic}", "none at that time", run.graph.publishers(topic))
    wrong = [one for one in moments if one.sent is None or not alike(one.sent, _wanted(one, topic))]
    if wrong:
        first = wrong[0]
        saw = "no command for 0.3 s" if first.sent is None else told(first.sent)
        expected = f"{told(_wanted(first, topic))} at {first.stamp:.3g} s, as on {topic}"
        raise Missed(expected, saw, hint, picture="topics")


def _wanted(moment: Moment, topic: str) -> tuple[float, float]:
    """What the driver of this topic wants, where that is known."""
    return (moment.joy if topic == JOY else moment.nav) or (0.0, 0.0)


def _moments(run: Recording) -> list[Moment]:
    """Ten a second, and each at which a command went out: a wrong one among right ones moves the robot."""
    joy, nav, sent = ours(run, JOY), ours(run, NAV), publishes(run, OUT, TWIST)
    # The ten are beside the moments at which timers fire.
    times = [index * STEP + 0.07 for index in range(BEGIN, int(run.ended.stamp / STEP))]
    looks = [(now, last(sent, now)) for now in times]
    looks += [(heard.stamp, heard) for heard in sent if heard.stamp >= BEGIN * STEP]
    found = []
    for now, out in sorted(looks, key=lambda look: look[0]):
        spoke = last(joy, now)
        found.append(
            Moment(
                now,
                _wish(joy, now),
                _wish(nav, now),
                spoke is None or now - spoke.stamp > OLD,
                speeds(out) if out and now - out.stamp < 0.3 else None,
            )
        )
    return found


def _wish(said: list[Message], now: Seconds) -> tuple[float, float] | None:
    """What a driver surely wants: young, and the same for a while."""
    lately = [heard for heard in said if now - STEADY <= heard.stamp <= now]
    wishes = {speeds(heard) for heard in lately}
    return wishes.pop() if len(lately) >= 2 and len(wishes) == 1 else None
