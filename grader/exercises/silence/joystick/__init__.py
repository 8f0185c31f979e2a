"""Deadlines: a joystick goes silent, and the robot stops."""

import itertools
import math

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.checks.twists import TWIST, Speeds, speeds, speeds_text
from grader.exercise import Exercise
from grader.exercises.silence.joystick.joystick import OFFERED, PAUSE, SilentJoystick
from grader.responses import EDGE, Window, from_course, last_before, top_speed
from sim.evidence import Message, Recording, Seconds

__all__ = ["SilentJoystick", "joystick"]

RAW, SENT = "/joystick", "/cmd_vel"
LAG = 0.12  # s, until a command has to be passed on
SOON, STOPPED = 0.4, 1.0  # s of silence, after which zeros go out, and after which the robot stands
LONGEST = 0.3  # s, a deadline that notices soon enough
STEP, STANDING = 0.05, 0.02  # s, m/s
PROFILE = "QoSProfile(depth=1, deadline=Duration(seconds=0.2)) is a profile with a deadline."

joystick = Exercise("joystick", "A joystick that falls silent", world="yard", seconds=10,
                    companions=[SilentJoystick], seeds=(1, 2))


@joystick.check(2)
def stands_between(run: Recording) -> None:
    """The node subscribes to /joystick, and publishes Twist messages on /cmd_vel."""
    with hinting("The joystick publishes on /joystick, and the robot subscribes to /cmd_vel."):
        subscribes(run, RAW, TWIST)
        publishes(run, SENT, TWIST, at_least=10)


@joystick.check(3, after=stands_between)
def passes_commands_on(run: Recording) -> None:
    """While the joystick publishes, the robot gets its commands, at most a tenth of a second later."""
    (begin, _), *_ = _silences(run)
    _alike(run, 0.5, begin, "Store the last command in the callback, and publish it in the timer.")


@joystick.check(7, after=passes_commands_on)
def stops_when_it_falls_silent(run: Recording) -> None:
    """When the joystick falls silent, zeros are published within 0.4 s, and the robot stops within 1 s."""
    for begin, end in _silences(run):
        speed = top_speed(run.during(begin + STOPPED, end).path).linear
        for moment, sent in _looks(run, begin + SOON, end):
            if sent != (0.0, 0.0):
                expected = f"zeros on {SENT}, {SOON:g} s after the joystick's last command (at {begin:.3g} s)"
                saw = f"{_text(sent)} at {moment:.3g} s; 1 s after it the robot drives at {speed:.2f} m/s"
                hint = _why_not_zero(run, begin + STOPPED, end)
                raise Missed(expected, saw, hint, picture="topics", unsafe=speed > STANDING)


@joystick.check(5, after=stops_when_it_falls_silent)
def requests_a_deadline(run: Recording) -> None:
    """Its subscription requests a deadline of 0.3 s or less, which the joystick can meet."""
    shortest = _deadline(run)
    if not OFFERED - EDGE <= shortest <= LONGEST + EDGE:
        saw = "none" if shortest == math.inf else f"{shortest:g} s"
        expected = f"a deadline from {OFFERED:g} s to {LONGEST:g} s in the QoS of the subscription"
        raise Missed(expected, saw, PROFILE)


@joystick.check(3, after=stops_when_it_falls_silent)
def goes_on_afterwards(run: Recording) -> None:
    """When the joystick publishes again, the robot gets its commands again."""
    guess = "A stop lasts until the next command arrives: from then on publish that one."
    ends = [end for _, end in _silences(run)]
    for end, begin in itertools.zip_longest(ends, [begin for begin, _ in _silences(run)][1:]):
        _alike(run, end + LAG, run.ended.stamp - STEP if begin is None else begin, guess)


def _silences(run: Recording) -> list[tuple[Seconds, Seconds]]:
    """Between which two commands the joystick published nothing for long."""
    stamps = [row.stamp for row in from_course(run, RAW, at_least=0)]
    found = [(a, b) for a, b in itertools.pairwise(stamps) if b - a > PAUSE / 2]
    if len(found) < 2:
        raise no_data(run, "two silences", f"{len(found)}", run.graph.publishers(RAW))
    return found


def _looks(run: Recording, begin: Seconds, end: Seconds) -> list[tuple[Seconds, Speeds | None]]:
    """Return what holds at moments between timers, and each command that is sent: in order."""
    rows = run.messages(SENT)
    moments = [begin + index * STEP + 0.012 for index in range(max(0, int((end - begin) / STEP)))]
    looks = [(moment, _last(rows, moment)) for moment in moments]
    looks += [(row.stamp, speeds(row)) for row in Window(begin, end).before(end).rows(rows)]
    return sorted(looks, key=lambda look: look[0])


def _alike(run: Recording, begin: Seconds, end: Seconds, guess: str) -> None:
    """Raises Missed where what is published isn't what the joystick published lately."""
    raw, wrong = from_course(run, RAW), []
    looks = _looks(run, begin, end)
    for moment, sent in looks:
        if sent not in {_last(raw, moment - lag) for lag in (0.0, LAG / 2, LAG)}:
            wrong.append((moment, _last(raw, moment), sent))
    if len(wrong) > 0.05 * len(looks):
        moment, wanted, sent = wrong[0]
        raise Missed(f"{_text(wanted)} at {moment:.3g} s, as the joystick commands", _text(sent), guess=guess)


def _last(messages: list[Message], moment: Seconds) -> Speeds | None:
    """The last command up to a moment; None without one lately."""
    row = last_before(messages, moment)
    return None if row is None or moment - row.stamp > LONGEST else speeds(row)


def _text(command: Speeds | None) -> str:
    return f"no command for {LONGEST:g} s" if command is None else speeds_text(command)


def _deadline(run: Recording) -> Seconds:
    """The shortest that a student's subscription requests."""
    requested = [end.qos["deadline"] for end in run.graph.subscriptions(RAW) if not end.from_course]
    return min((limit for limit in requested if limit is not None), default=math.inf)


def _why_not_zero(run: Recording, begin: Seconds, end: Seconds) -> str:
    if _deadline(run) > LONGEST + EDGE:
        return f"A late message isn't reported unless you request a deadline. {PROFILE}"
    if not run.during(begin, end).messages(SENT):
        return "Say stop, and keep saying it: let the timer publish all the time, zeros too."
    return ("The callback for a missed deadline belongs to the subscription: "
            "event_callbacks=SubscriptionEventCallbacks(deadline=self.too_late). In it, set the whole "
            "command to "
            "zero.")
