"""A velocity mux: two drivers, one robot."""

from typing import NamedTuple

from grader.checks import Missed, publishes, subscribes
from grader.checks.no_data import no_data
from grader.checks.twists import OUT, SAME, TWIST, Speeds, speeds, speeds_text
from grader.companions.drivers import JOY, NAV, Drivers
from grader.companions.radios import WIFI
from grader.exercise import Exercise, Scenario
from grader.responses import Window, from_course, last_before, require_standing, same
from grader.variants import Variants
from grader.worlds.trusting import trusting
from sim.evidence import Message, Recording, Seconds

OLD, FRESH = 0.35, 0.15  # s after and before the time-out: certainly old or fresh, over the network, too
STEP, BEGIN, SILENT = 0.1, 0.5, 0.3  # s
ARRIVED = 0.24  # s, within which a command has certainly come over the network, and gone out again
ZERO = "A 0 from the joystick is a command, too: check how old it is, not how fast."
FIRST = "Check the joystick first: while its command is less than {} s old, the navigator has to wait."

mux = Exercise("mux", "Two drivers, one robot", scenarios=[
    Scenario("yard", 15, 1, [Drivers]),
    Scenario(trusting("yard"), 15, 2, [Drivers], network=WIFI),
], variants=Variants(
    {"timeout": (0.5, 1.0), "stopped": (1.0, 1.5)},  # s
    texts=("{timeout} s ago", "The {timeout} s leaves", "< {timeout}", "for {timeout} s",
           "within {stopped:g} s"),
))


class MuxSample(NamedTuple):
    """The drivers' commands at a moment, and the robot's.

    A driver is None where its command is old, or has just changed.
    """

    stamp: Seconds
    joy: Speeds | None
    nav: Speeds | None
    joy_is_old: bool
    sent: Speeds | None

    def wanted(self, topic: str) -> Speeds:
        """Return what the driver on this topic wants."""
        return (self.joy if topic == JOY else self.nav) or (0.0, 0.0)


@mux.check(3, guess="Create two subscriptions, one for each driver, and a publisher for the robot.")
def stands_between(run: Recording) -> None:
    """The node subscribes to /cmd_vel_joy and /cmd_vel_nav, and publishes Twist messages on /cmd_vel."""
    for topic in (JOY, NAV):
        subscribes(run, topic, TWIST)
    publishes(run, OUT, TWIST, at_least=10)


@mux.check(5, after=stands_between)
def passes_the_navigator(run: Recording) -> None:
    """Before the joystick is touched, the robot obeys the navigator."""
    first = from_course(run, JOY)[0].stamp
    samples = [sample for sample in _samples(run) if sample.nav and sample.stamp < first]
    hint = ("Store the navigator's last command and when it arrived; while it is less than "
            f"{mux.drawn.timeout} s old, publish it.")
    _compare(run, samples, NAV, hint)


@mux.check(6, after=passes_the_navigator)
def joystick_wins(run: Recording) -> None:
    """While the joystick publishes, only its commands count, even if it sends 0."""
    samples = [sample for sample in _samples(run) if sample.joy]
    stops = [sample for sample in samples if sample.joy == (0.0, 0.0)]
    first = FIRST.format(mux.drawn.timeout)
    try:
        _compare(run, [sample for sample in samples if sample.joy != (0.0, 0.0)], JOY, first)
    except Missed as missed:
        missed.unsafe = any(sample.sent is not None and any(sample.sent) for sample in stops)
        raise
    _compare(run, stops, JOY, ZERO)


@mux.check(3, after=joystick_wins)
def gives_back(run: Recording) -> None:
    """When the joystick has been silent for 0.5 s, the navigator drives again."""
    first = from_course(run, JOY)[0].stamp
    samples = [sample for sample in _samples(run) if sample.nav and sample.joy_is_old]
    hint = ("The joystick's last command never expires: compare the time since it arrived with "
            f"{mux.drawn.timeout} s.")
    _compare(run, [sample for sample in samples if sample.stamp > first], NAV, hint)


@mux.check(5, after=passes_the_navigator)
def stands_without_both(run: Recording) -> None:
    """When both have fallen silent, the robot stops within 1 s, until one of them publishes again."""
    sent = sorted(row.stamp for topic in (JOY, NAV) for row in from_course(run, topic))
    limits = mux.drawn
    hint = ("Both drivers' commands expire. Check their ages every time, by the clock, and publish an empty "
            f"Twist when neither is less than {limits.timeout} s old.")
    for begin, end in zip(sent, [*sent[1:], run.ended.stamp], strict=True):
        if end - begin > limits.stopped:
            why = f"{limits.stopped:g} s after the last command, at {begin:.3g} s"
            require_standing(run, Window(begin + limits.stopped, end), why, hint)


def _compare(run: Recording, samples: list[MuxSample], topic: str, hint: str) -> None:
    """Raises Missed at the first moment at which the robot is not commanded what this driver wants."""
    if not samples:
        raise no_data(run, f"commands on {topic}", "none at that time", run.graph.publishers(topic))
    for sample in samples:
        if sample.sent is None or not same(sample.sent, sample.wanted(topic), SAME):
            saw = f"no command for {SILENT:g} s" if sample.sent is None else speeds_text(sample.sent)
            expected = f"{speeds_text(sample.wanted(topic))} at {sample.stamp:.3g} s, as on {topic}"
            is_stop = sample.sent is not None and not any(sample.wanted(topic))
            raise Missed(expected, saw, hint, picture="topics", unsafe=is_stop)


def _samples(run: Recording) -> list[MuxSample]:
    """Ten a second, and one for each command: a wrong one among right ones moves the robot."""
    joy, nav, sent = from_course(run, JOY), from_course(run, NAV), publishes(run, OUT, TWIST)
    # Those of a tenth are beside the moments at which timers fire.
    times = [index * STEP + 0.07 for index in range(round(BEGIN / STEP), int(run.ended.stamp / STEP))]
    looks = [(now, last_before(sent, now)) for now in times]
    looks += [(row.stamp, row) for row in sent if row.stamp >= BEGIN]
    found = []
    for now, out in sorted(looks, key=lambda look: look[0]):
        newest = last_before(joy, now)
        is_old = newest is None or now - newest.stamp > mux.drawn.timeout + OLD
        command = speeds(out) if out and now - out.stamp < SILENT else None
        found.append(MuxSample(now, _steady(joy, now), _steady(nav, now), is_old, command))
    return found


def _steady(sent: list[Message], now: Seconds) -> Speeds | None:
    """Return what a driver wants for certain: fresh, and the same for a while."""
    rows = Window(now - (mux.drawn.timeout - FRESH), now).rows(sent)
    wanted = {speeds(row) for row in rows}
    arrived = len(rows) >= 2 and rows[0].stamp <= now - ARRIVED
    return wanted.pop() if arrived and len(wanted) == 1 else None
