"""The project: a mode manager, made of a parameter, two services and a bumper."""

from __future__ import annotations

from grader.checks import Missed, check, named, publishes
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.services.calls import Call, accepted, asked, calls, not_so, offers, refused
from grader.exercises.services.partners import Operator
from sim.recording import Recording, Seconds

ARM, RESET, SET = "/arm", "/reset", "/manager/set_parameters"
MODES = {"idle": (0.0, 0.0), "ahead": (0.4, 0.0), "back": (-0.3, 0.0), "circle": (0.2, 0.8)}  # m/s, rad/s
SOON = 0.3  # seconds until a change shows in the commands


@check(points=3)
def offers_its_services(recording: Recording) -> None:
    """The node /manager offers /arm (SetBool) and /reset (Trigger), and has a parameter `mode`."""
    named(recording, "/manager")
    offers(recording, ARM, "std_srvs/srv/SetBool")
    offers(recording, RESET, "std_srvs/srv/Trigger")
    first = asked(recording, SET)[0]
    if not accepted(first):
        hint = 'self.declare_parameter("mode", "idle") in __init__.'
        if "invalid type" in first.response.get("reason", ""):
            hint = "check has to return something for a good mode, too: SetParametersResult(successful=True)."
        not_so(recording, f"successful=True for {first.question}", first, hint)


@check(points=5, after=offers_its_services)
def drives_as_the_mode_says(recording: Recording) -> None:
    """While it is armed, /cmd_vel says what the mode says; otherwise it says zero."""
    publishes(recording, "/cmd_vel", "geometry_msgs/msg/Twist")
    asked(recording, ARM, at_least=3)
    bump = _bump(recording)
    mode, armed = "idle", False
    for moment, until, call in _phases(recording):
        if moment >= bump:
            break
        if call and call.service == SET and call.request["mode"] in MODES:
            mode = call.request["mode"]
        if call and call.service == ARM:
            armed = call.request["data"]
            _is_accepted(recording, call, "Set response.success = True, and return response.")
        wanted = MODES[mode] if armed else (0.0, 0.0)
        why = f"in the mode {mode}, {'armed' if armed else 'not armed'}"
        _commands(recording, wanted, moment + SOON, min(until, bump), why)


@check(points=3, after=offers_its_services)
def refuses_other_modes(recording: Recording) -> None:
    """A mode that it doesn't know is refused, with a reason."""
    call = next(call for call in asked(recording, SET, at_least=3) if call.request["mode"] not in MODES)
    if not refused(call) or not call.response["reason"].strip():
        hint = 'If p.value not in MODES: return SetParametersResult(successful=False, reason="...").'
        not_so(recording, f"successful=False and a reason for {call.question}", call, hint)


@check(points=5, after=drives_as_the_mode_says)
def stops_when_it_bumps(recording: Recording) -> None:
    """When the robot bumps into something it stops, and refuses to be armed until it is reset."""
    bump = _bump(recording)
    again, *_ = [call for call in calls(recording, ARM) if call.asked > bump] or [None]
    if again is None:
        expected, saw = "a robot that drives ahead until it bumps", "it never came to a wall"
        raise Missed(expected, saw, "In drive: MODES[mode].", picture="path")
    _commands(recording, (0.0, 0.0), bump + SOON, again.asked, "after the bump")
    refusal = refused(again)
    if not refusal or not again.response["message"].strip():
        hint = (
            "In arm: if request.data and self.bumped, then success is False, and the message says what to "
            "do; otherwise self.armed = request.data."
        )
        expected = f"success=False and a message for {again.question}"
        not_so(recording, expected, again, hint, credit=0.6 if refusal else 0.0)
    reset = asked(recording, RESET)[0]
    _commands(recording, (0.0, 0.0), again.asked, reset.asked, "after arming was refused")


@check(points=3, after=stops_when_it_bumps)
def drives_on_after_a_reset(recording: Recording) -> None:
    """After /reset it can be armed again, and drives."""
    reset = asked(recording, RESET)[0]
    if not accepted(reset):
        hint = "In reset: self.bumped = False, response.success = True, return response."
        not_so(recording, f"success=True for {reset.question}", reset, hint)
    arm, disarm = asked(recording, ARM, at_least=6)[-2:]
    _commands(recording, (0.0, 0.0), reset.asked, arm.asked, "after the reset, not armed yet")
    hint = (
        "reset has to take back what the bump has set: self.bumped = False. And touching the wall still "
        "is no new bump."
    )
    _is_accepted(recording, arm, hint)
    why = "in the mode back, armed after a reset"
    _commands(recording, MODES["back"], arm.asked + SOON, disarm.asked, why)


def _bump(recording: Recording) -> Seconds:
    """When the bumper spoke for the first time; the end of the run if it never did."""
    pressed = [heard.stamp for heard in recording.messages("/bumper") if heard.message.data]
    return pressed[0] if pressed else recording.ended.stamp


def _phases(recording: Recording) -> list[tuple[Seconds, Seconds, Call | None]]:
    """From each call to the next one; before the first there is none."""
    asked = sorted((*calls(recording, ARM), *calls(recording, SET)), key=lambda call: call.asked)
    begins = [0.0, *(call.asked for call in asked)]
    return list(zip(begins, [*begins[1:], recording.ended.stamp], [None, *asked], strict=True))


def _is_accepted(recording: Recording, call: Call, hint: str) -> None:
    if not accepted(call):
        not_so(recording, f"success=True for {call.question}", call, hint)


def _commands(
    recording: Recording, wanted: tuple[float, float], begin: Seconds, end: Seconds, why: str
) -> None:
    """The commands between two moments are these; without any the robot stands still."""
    sent = [heard for heard in recording.messages("/cmd_vel") if begin <= heard.stamp < end]
    found = [(h.stamp, h.message.linear.x, h.message.angular.z) for h in sent]
    wrong = [it for it in found if max(abs(it[1] - wanted[0]), abs(it[2] - wanted[1])) > 1e-3]
    if wrong or (not found and any(wanted) and end - begin > SOON):
        at, v, w = wrong[0] if wrong else (begin, 0.0, 0.0)
        saw = f"({v:g} m/s, {w:g} rad/s) at {at:.3g} s" if wrong else f"no command from {at:.3g} s on"
        expected = f"({wanted[0]:g} m/s, {wanted[1]:g} rad/s) {why}"
        with advising(recording, _command_hint(wanted, why)):
            raise Missed(expected, saw, picture="path")


def _command_hint(wanted: tuple[float, float], why: str) -> str:
    if any(wanted):
        return (
            'In drive, while armed: msg.linear.x, msg.angular.z = MODES[self.get_parameter("mode").value], '
            "asked for anew each time."
        )
    if "bump" in why:
        return "In on_bumper, when the robot has just bumped: self.armed = False and self.bumped = True."
    return "Only arming makes the robot drive: look at self.armed in drive, and send zeros without it."


modes = Exercise(
    "modes",
    "A mode manager",
    [
        offers_its_services,
        drives_as_the_mode_says,
        refuses_other_modes,
        stops_when_it_bumps,
        drives_on_after_a_reset,
    ],
    world="room",
    seconds=40,
    companions=[Operator],
    seeds=(1, 2),
)
