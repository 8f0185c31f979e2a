"""An exercise on a service that does something to the robot: it drives only while it is armed."""

from __future__ import annotations

import itertools
import math
import re

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.services.calls import Call, accepted, asked, not_so, offers
from grader.exercises.services.partners import Pilot
from sim.recording import Recording, Seconds

ARM, SET_BOOL = "/arm", "std_srvs/srv/SetBool"
CALLS = 6  # that the pilot makes
SPEED = 0.3  # m/s
INVERTED = "Each call did the opposite of what it asked for: self.armed = request.data."
SETTLING = 0.8  # seconds: without commands the robot stops after 0.5 s, and braking takes time


@check(points=3)
def offers_to_arm(recording: Recording) -> None:
    """The node offers the service /arm of type SetBool."""
    offers(recording, ARM, SET_BOOL)


@check(points=3, after=offers_to_arm)
def says_what_it_did(recording: Recording) -> None:
    """Every call is answered with success, and with the message `armed` or `disarmed`."""
    for call in asked(recording, ARM, CALLS):
        if not _is_answered(call):
            expected = f"success=True, message={_word(call)!r} for {call.question}"
            not_so(recording, expected, call, _answering_hint(recording, call))


@check(points=4, after=offers_to_arm)
def drives_while_armed(recording: Recording) -> None:
    """While it is armed, the robot drives ahead at 0.3 m/s."""
    for call, until in _phases(recording, armed=True):
        seconds = until - call.asked - SETTLING
        driven = _driven(recording, call.asked + SETTLING, until)
        if not math.isclose(driven, SPEED * seconds, rel_tol=0.15):
            raise Missed(
                f"{SPEED} m/s after {call.question}",
                f"{driven / seconds:.2g} m/s",
                _driving_hint(recording, call),
                picture="path",
            )


@check(points=4, after=drives_while_armed)
def stands_while_disarmed(recording: Recording) -> None:
    """While it is not armed, the robot stands still: at the start, too."""
    first = asked(recording, ARM, CALLS)[0]
    phases = [(0.0, first.asked, "before the first call")]
    phases += [
        (call.asked + SETTLING, until, f"after {call.question}")
        for call, until in _phases(recording, armed=False)
    ]
    for begin, end, when in phases:
        driven = _driven(recording, begin, end)
        if driven > 0.01:
            saw = f"it moved {driven:.2f} m"
            raise Missed(f"a robot that stands still {when}", saw, _standing_hint(when), picture="path")


def _word(call: Call) -> str:
    return "armed" if call.request["data"] else "disarmed"


def _is_answered(call: Call) -> bool:
    return accepted(call) and _said(call) == [_word(call)]


def _said(call: Call) -> list[str]:
    return re.findall(r"\b(?:dis)?armed\b", call.response.get("message", "").lower())


def _phases(recording: Recording, *, armed: bool) -> list[tuple[Call, Seconds]]:
    """The calls that armed or disarmed, each with the moment of the next call."""
    made = asked(recording, ARM, CALLS)
    ends = [*(call.asked for call in made[1:]), recording.ended.stamp]
    return [(call, end) for call, end in zip(made, ends, strict=True) if call.request["data"] == armed]


def _driven(recording: Recording, begin: Seconds, end: Seconds) -> float:
    """Metres between two moments."""
    poses = [pose for pose in recording.path if begin <= pose.stamp <= end]
    steps = itertools.pairwise(poses)
    return sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in steps)


def _is_inverted(recording: Recording) -> bool:
    """Whether each call did the opposite of what it asked for, as its message says."""
    made = asked(recording, ARM, CALLS)
    return all(len(_said(call)) == 1 and _said(call) != [_word(call)] for call in made)


def _answering_hint(recording: Recording, call: Call) -> str:
    if _is_inverted(recording):
        return INVERTED
    if _said(call) == [_word(call)]:
        return "success says whether the call went well, and here it always does. The message says the rest."
    if accepted(call):
        return 'The message says what holds after this call: "armed" if self.armed else "disarmed".'
    return "Set response.success and response.message, then return response."


def _driving_hint(recording: Recording, call: Call) -> str:
    made = asked(recording, ARM, CALLS)
    before = [other for other in made if other.asked < call.asked]
    speeds = {heard.message.linear.x for heard in recording.messages("/cmd_vel")}
    if not speeds:
        return "Nothing was published on /cmd_vel: publish a Twist in drive, each time."
    if _is_inverted(recording):
        return INVERTED
    if speeds == {0.0} and any(heard.message.angular.z for heard in recording.messages("/cmd_vel")):
        return "It turns on the spot: the speed ahead is linear.x; angular.z is how fast it turns."
    if speeds == {0.0}:
        return "All commands were 0: does arm set self.armed (with self), and does drive look at it?"
    if before and _driven(recording, made[0].asked, made[1].asked) > 0.1:
        return "Each call switches over, whatever it asks for: write self.armed = request.data."
    if before and before[-1].request["data"]:
        return "A second data=True must not switch it off again: write self.armed = request.data."
    return f"In drive: linear.x = {SPEED} if self.armed. Send a command at each call, 10 times a second."


def _standing_hint(when: str) -> str:
    if when.startswith("before"):
        return "A robot must not start by itself: self.armed = False in __init__, and drive looks at it."
    return "request.data says what is wanted: self.armed = request.data. While it is False, send zeros."


arming = Exercise(
    "arming",
    "A robot that drives only when it is armed",
    [offers_to_arm, says_what_it_did, drives_while_armed, stands_while_disarmed],
    world="yard",
    seconds=14,
    companions=[Pilot],
    seeds=(1, 2),
)
