"""A service with an effect on the robot: it drives only while it is armed."""

import itertools
import math
import re

from grader.checks import Missed, ends_with_a_stop, offers, otherwise, series, traveled, wrong_response
from grader.checks.services import call_text, course_calls, is_success, response_fields, sent_at
from grader.companions.service_clients import Pilot
from grader.diagnosis.driving import still_obeyed
from grader.exercise import Exercise, Scenario
from grader.variants import Variants
from grader.worlds.trusting import trusting
from sim.evidence import Call, Recording

ARM = "/arm"
CALLS = 6  # that the pilot makes
STILL, JUST = 0.01, 0.3  # meters, seconds
INVERTED = "Each call did the opposite of its request: write self.armed = request.data."
SWITCHES = "Each call toggles it, whatever the request: write self.armed = request.data."
NOT_YET = "A robot must not start by itself: set self.armed = False in __init__, and check it in drive."
NO_MORE = ("request.data is the state that the caller wants: self.armed = request.data. While it is False, "
           "send zeros.")
SETTLING = 0.8  # seconds: without commands the robot stops after 0.5 s, and braking takes time

arming = Exercise("arming", "A robot that drives only when it is armed", scenarios=[
    Scenario("yard", 17, 1, [Pilot]),
    Scenario(trusting("yard"), 17, 2, [Pilot]),
], variants=Variants(
    {"speed": (0.3, 0.2, 0.25)},
    {"on": ("armed", "enabled", "ready"), "off": ("disarmed", "disabled", "locked")},
    texts=("{speed:g} m/s", "linear.x = {speed:g}", "`{on}` or `{off}`", '"{on}" if self.armed else "{off}"'),
))


@arming.check(3)
def offers_to_arm(run: Recording) -> None:
    """The node offers the service /arm of type SetBool."""
    offers(run, ARM, "std_srvs/srv/SetBool")


@arming.check(3, after=offers_to_arm, guess={
    INVERTED: lambda run, call: _is_inverted(run),
    "success tells the caller whether the call worked, and here it always does. The state goes in message.":
        lambda run, call: _words(call) == [_word(call)],
    'The message is the state after this call: "armed" if self.armed else "disarmed".': (
        lambda run, call: is_success(call)
    ),
})
def reports_its_state(run: Recording) -> None:
    """Every call responds with success, and with the message `armed` or `disarmed`."""
    for call in course_calls(run, ARM, CALLS):
        if not is_success(call) or _words(call) != [_word(call)]:
            raise wrong_response(f"success=True, message={_word(call)!r} for {call_text(call)}", call)


@arming.check(4, after=offers_to_arm, hints={
    "Nothing was published on /cmd_vel: publish a Twist in drive, each time.":
        lambda run, call: not run.messages("/cmd_vel"),
    INVERTED: lambda run, call: _is_inverted(run),
    "It turns on the spot: linear.x is the forward speed; angular.z is how fast it turns.":
        lambda run, call: not _commands(run, "linear.x") and _commands(run, "angular.z"),
    "All commands were 0: does arm set self.armed (with self), and does drive check it?":
        lambda run, call: not _commands(run, "linear.x"),
    SWITCHES: lambda run, call: _drives_before_the_second_call(run, call),
    "A second data=True must not switch it off again: write self.armed = request.data.":
        lambda run, call: any(other.request.data for other in _before(run, call)[-1:]),
    "In drive: linear.x = 0.3 if self.armed. Publish a command every time drive is called, 10 times a "
    "second.": otherwise,
})
def drives_while_armed(run: Recording) -> None:
    """While it is armed, the robot drives ahead at 0.3 m/s."""
    first = course_calls(run, ARM, CALLS)[0]
    _stands(run, run.during(0.0, sent_at(first)), "before the first call", NOT_YET)
    _begins_when_armed(run)
    for call, phase in _phases(run, armed=True):
        # From the first pose to the last: they are up to 50 ms inside the phase, which may be short.
        seconds = phase.path[-1].stamp - phase.path[0].stamp if phase.path else 0.0
        speed = traveled(phase) / seconds if seconds else 0.0
        if not math.isclose(speed, arming.drawn.speed, rel_tol=0.15):
            expected, saw = f"{arming.drawn.speed} m/s after {call_text(call)}", f"{speed:.2g} m/s"
            raise Missed(expected, saw, picture="path", about=(call,))


@arming.check(4, after=drives_while_armed)
def stands_while_disarmed(run: Recording) -> None:
    """While it is not armed, the robot stands still, at the start as well."""
    for call, phase in _phases(run, armed=False):
        _stands(run, phase, f"after {call_text(call)}", NO_MORE)
    ends_with_a_stop(run, credit=0.5)


def _begins_when_armed(run: Recording) -> None:
    """Just before a call that arms it, no command moves the robot. Raises Missed if not.

    A robot that still obeys an earlier command is left to `stands_while_disarmed`.
    """
    made = course_calls(run, ARM, CALLS)
    for before, call in itertools.pairwise(made):
        if call.request.data and not before.request.data:
            begin = max(sent_at(before) + SETTLING, sent_at(call) - JUST)
            armed = run.during(sent_at(made[1]) + SETTLING, sent_at(made[2]))
            hint = INVERTED if _is_inverted(run) else NO_MORE if traveled(armed) > 10 * STILL else SWITCHES
            if not still_obeyed(run, begin):
                _stands(run, run.during(begin, sent_at(call)), f"until {call_text(call)}", hint)


def _stands(run: Recording, phase: Recording, when: str, hint: str) -> None:
    driven = traveled(phase)
    if driven > STILL:
        expected, saw = f"a robot that stands still {when}", f"it moved {driven:.2f} m"
        hint = still_obeyed(run, phase.stamp) or hint
        raise Missed(expected, saw, hint, picture="path", unsafe=True)


def _phases(run: Recording, *, armed: bool) -> list[tuple[Call, Recording]]:
    """The calls that armed or disarmed, each with the run until the next call."""
    made = course_calls(run, ARM, CALLS)
    ends = [*map(sent_at, made[1:]), run.ended.stamp]
    phases = (run.during(sent_at(call) + SETTLING, end) for call, end in zip(made, ends, strict=True))
    return [(call, phase) for call, phase in zip(made, phases, strict=True) if call.request.data == armed]


def _word(call: Call) -> str:
    return str(arming.drawn.on if call.request.data else arming.drawn.off)


def _words(call: Call) -> list[str]:
    either = rf"\b(?:{arming.drawn.on}|{arming.drawn.off})\b"
    return re.findall(either, response_fields(call).get("message", "").lower())


def _is_inverted(run: Recording) -> bool:
    """Return whether each call did the opposite of its request, by its message."""
    made = course_calls(run, ARM, CALLS)
    return all(len(_words(call)) == 1 and _words(call) != [_word(call)] for call in made)


def _before(run: Recording, call: Call) -> list[Call]:
    return [other for other in course_calls(run, ARM, CALLS) if sent_at(other) < sent_at(call)]


def _commands(run: Recording, field: str) -> bool:
    return any(value for _, value in series(run, "/cmd_vel", field))


def _drives_before_the_second_call(run: Recording, call: Call) -> bool:
    first, second = course_calls(run, ARM, CALLS)[:2]
    return bool(_before(run, call)) and traveled(run.during(sent_at(first), sent_at(second))) > 0.1
