"""An exercise on a service that does something to the robot: it drives only while it is armed."""

from __future__ import annotations

import itertools
import math
import re

from grader.checks import Missed, ends_with_a_stop, travelled
from grader.checks.services import question
from grader.exercise import Exercise
from grader.exercises.services.calls import accepted, answer, offers, our_calls, wrong_answer
from grader.exercises.services.partners import Pilot
from sim.evidence import Call, Recording

ARM = "/arm"
CALLS = 6  # that the pilot makes
SPEED = 0.3  # m/s
STILL, JUST = 0.01, 0.3  # metres, seconds
INVERTED = "Each call did the opposite of what it asked for: self.armed = request.data."
SWITCHES = "Each call switches over, whatever it asks for: write self.armed = request.data."
NOT_YET = "A robot must not start by itself: self.armed = False in __init__, and drive looks at it."
NO_MORE = "request.data says what is wanted: self.armed = request.data. While it is False, send zeros."
SETTLING = 0.8  # seconds: without commands the robot stops after 0.5 s, and braking takes time

arming = Exercise(
    "arming",
    "A robot that drives only when it is armed",
    world="yard",
    seconds=17,
    companions=[Pilot],
    seeds=(1, 2),
)


@arming.check(3)
def offers_to_arm(run: Recording) -> None:
    """The node offers the service /arm of type SetBool."""
    offers(run, ARM, "std_srvs/srv/SetBool")


@arming.check(3, after=offers_to_arm)
def says_what_it_did(run: Recording) -> None:
    """Every call is answered with success, and with the message `armed` or `disarmed`."""
    made = our_calls(run, ARM, CALLS)
    for call in made:
        if not accepted(call) or _said(call) != [_word(call)]:
            expected = f"success=True, message={_word(call)!r} for {question(call)}"
            raise wrong_answer(expected, call, _answering_hint(made, call))


@arming.check(4, after=offers_to_arm)
def drives_while_armed(run: Recording) -> None:
    """While it is armed, the robot drives ahead at 0.3 m/s."""
    _stands(run.during(0.0, our_calls(run, ARM, CALLS)[0].requested), "before the first call", NOT_YET)
    _begins_when_armed(run)
    for call, phase in _phases(run, armed=True):
        speed = _mean_speed(phase)
        if not math.isclose(speed, SPEED, rel_tol=0.15):
            raise Missed(
                f"{SPEED} m/s after {question(call)}",
                f"{speed:.2g} m/s",
                _driving_hint(run, call),
                picture="path",
            )


@arming.check(4, after=drives_while_armed)
def stands_while_disarmed(run: Recording) -> None:
    """While it is not armed, the robot stands still: at the start, too."""
    for call, phase in _phases(run, armed=False):
        _stands(phase, f"after {question(call)}", NO_MORE)
    ends_with_a_stop(run, credit=0.5)


def _mean_speed(phase: Recording) -> float:
    """In m/s, from the first pose to the last; they lie up to 50 ms within the phase, which may be short."""
    seconds = phase.path[-1].stamp - phase.path[0].stamp if phase.path else 0.0
    return travelled(phase) / seconds if seconds else 0.0


def _begins_when_armed(run: Recording) -> None:
    """Just before a call that arms it, the robot stands. Raises Missed if not."""
    made = our_calls(run, ARM, CALLS)
    for before, call in itertools.pairwise(made):
        if call.request.data and not before.request.data:
            begin = max(before.requested + SETTLING, call.requested - JUST)
            _stands(run.during(begin, call.requested), f"until {question(call)}", _why_it_drives(run, made))


def _why_it_drives(run: Recording, made: list[Call]) -> str:
    """The usual reasons for a robot that drives while it isn't armed."""
    if _is_inverted(made):
        return INVERTED
    armed = run.during(made[1].requested + SETTLING, made[2].requested)
    return NO_MORE if travelled(armed) > 10 * STILL else SWITCHES


def _stands(phase: Recording, when: str, hint: str) -> None:
    driven = travelled(phase)
    if driven > STILL:
        expected, saw = f"a robot that stands still {when}", f"it moved {driven:.2f} m"
        raise Missed(expected, saw, hint, picture="path", unsafe=True)


def _phases(run: Recording, *, armed: bool) -> list[tuple[Call, Recording]]:
    """The calls that armed or disarmed, each with what came of it before the next call."""
    made = our_calls(run, ARM, CALLS)
    ends = [*(call.requested for call in made[1:]), run.ended.stamp]
    return [
        (call, run.during(call.requested + SETTLING, end))
        for call, end in zip(made, ends, strict=True)
        if call.request.data == armed
    ]


def _word(call: Call) -> str:
    return "armed" if call.request.data else "disarmed"


def _said(call: Call) -> list[str]:
    return re.findall(r"\b(?:dis)?armed\b", answer(call).get("message", "").lower())


def _is_inverted(made: list[Call]) -> bool:
    """Whether each call did the opposite of what it asked for, as its message says."""
    return all(len(_said(call)) == 1 and _said(call) != [_word(call)] for call in made)


def _answering_hint(made: list[Call], call: Call) -> str:
    if _is_inverted(made):
        return INVERTED
    if _said(call) == [_word(call)]:
        return "success says whether the call went well, and here it always does. The message says the rest."
    if accepted(call):
        return 'The message says how things are after this call: "armed" if self.armed else "disarmed".'
    return "Set response.success and response.message, then return response."


def _driving_hint(run: Recording, call: Call) -> str:
    made = our_calls(run, ARM, CALLS)
    before = [other for other in made if other.requested < call.requested]
    commands = [heard.message for heard in run.messages("/cmd_vel")]
    if not commands:
        return "Nothing was published on /cmd_vel: publish a Twist in drive, each time."
    if _is_inverted(made):
        return INVERTED
    if not any(command.linear.x for command in commands):
        if any(command.angular.z for command in commands):
            return "It turns on the spot: the speed ahead is linear.x; angular.z is how fast it turns."
        return "All commands were 0: does arm set self.armed (with self), and does drive look at it?"
    if before and travelled(run.during(made[0].requested, made[1].requested)) > 0.1:
        return SWITCHES
    if before and before[-1].request.data:
        return "A second data=True must not switch it off again: write self.armed = request.data."
    return f"In drive: linear.x = {SPEED} if self.armed. Send a command at each call, 10 times a second."
