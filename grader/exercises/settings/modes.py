"""A mode manager: a parameter, two services and a bumper."""

from functools import partial

from grader.checks import Missed, course_calls, ends_with_a_stop, named, offers, publishes, wrong_response
from grader.checks.fields import plain
from grader.checks.services import call_text, is_refusal, is_success, response_fields, sent_at
from grader.companions.parameter_start import started_with
from grader.companions.service_clients import ModeReader, Operator
from grader.exercise import Exercise, Scenario
from grader.responses import Window, last_before, same
from sim.evidence import Call, Recording, Seconds

ARM, RESET = "/arm", "/reset"
GET, SET = "/manager/get_parameters", "/manager/set_parameters"
STRANGE = "sideways"  # a mode with which it is started once
Velocity = tuple[float, float]  # m/s, rad/s
MODES = {"idle": (0.0, 0.0), "ahead": (0.4, 0.0), "back": (-0.3, 0.0), "circle": (0.2, 0.8)}
STOPPED: Velocity = (0.0, 0.0)
SOON = 0.3  # seconds until a change shows in the commands
DRIVE = (
    'In drive, while armed: msg.linear.x, msg.angular.z = MODES[self.get_parameter("mode").value], '
    "looked up each time."
)
BUMPED = "In on_bumper, when the robot has just bumped: self.armed = False and self.bumped = True."
UNARMED = "Only an armed robot may drive: check self.armed in drive, and send zeros while it is False."

modes = Exercise("modes", "A mode manager", scenarios=[
    Scenario("room", 40, 1, [Operator], name="operated"),
    Scenario("room", 40, 2, [Operator], name="operated"),
    Scenario("room", 2, 1, [ModeReader], name="strange", prepare=partial(started_with, "mode", STRANGE)),
])


@modes.check(3, only="operated")
def offers_its_services(run: Recording) -> None:
    """The node /manager offers /arm (SetBool) and /reset (Trigger), and has a parameter `mode`."""
    named(run, "/manager")
    offers(run, ARM, "std_srvs/srv/SetBool")
    offers(run, RESET, "std_srvs/srv/Trigger")
    first = course_calls(run, SET)[0]
    if not is_success(first):
        guess = 'self.declare_parameter("mode", "idle") in __init__.'
        raise wrong_response(f"successful=True for {call_text(first)}", first, guess)


@modes.check(5, after=offers_its_services, only="operated")
def drives_as_the_mode_says(run: Recording) -> Seconds:
    """While it is armed, /cmd_vel has the mode's command; otherwise zero."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    course_calls(run, ARM, at_least=3)
    pressed = [row.stamp for row in run.messages("/bumper") if row.message.data]
    bump = pressed[0] if pressed else run.ended.stamp
    mode, armed = "idle", False
    for call, phase in _phases(run.during(0.0, bump)):
        if call and call.service == SET and _mode(call) in MODES:
            mode = _mode(call)
        if call and call.service == ARM:
            armed = call.request.data
            _is_accepted(call, "Set response.success = True, and return response.")
        why = f"in the mode {mode}, {'armed' if armed else 'not armed'}"
        _commands(run, phase, MODES[mode] if armed else STOPPED, why)
    return bump


@modes.check(3, after=offers_its_services)
def refuses_other_modes(run: Recording) -> None:
    """An unknown mode is refused, with a reason, at the start as well."""
    if not run.calls_of(SET):  # not set in this run
        _starts_with_no_other(run)
        return
    call = next(call for call in course_calls(run, SET, at_least=3) if _mode(call) not in MODES)
    if not is_refusal(call) or not response_fields(call)["reason"].strip():
        guess = 'If p.value not in MODES: return SetParametersResult(successful=False, reason="...").'
        raise wrong_response(f"successful=False and a reason for {call_text(call)}", call, guess)


@modes.check(5, after=drives_as_the_mode_says, only="operated")
def stops_when_it_bumps(run: Recording, bump: Seconds) -> None:
    """When the robot bumps into something it stops, and refuses to be armed until it is reset."""
    again = course_calls(run.during(bump), ARM)[0]
    _commands(run, Window(bump + SOON, sent_at(again)), STOPPED, "after the bump", BUMPED)
    refusal = is_refusal(again)
    if not refusal or not again.response.message.strip():
        guess = ("In arm: if request.data and self.bumped, set success to False and let the message say what "
                 "to do; otherwise self.armed = request.data.")
        expected = f"success=False and a message for {call_text(again)}"
        missed = wrong_response(expected, again, guess, credit=0.6 if refusal else 0.0)
        missed.unsafe = is_success(again)  # it lets itself be armed at the wall
        raise missed
    reset = course_calls(run, RESET)[0]
    _commands(run, Window(sent_at(again), sent_at(reset)), STOPPED, "after arming was refused")


@modes.check(3, after=stops_when_it_bumps, only="operated")
def drives_on_after_a_reset(run: Recording) -> None:
    """After /reset it can be armed again, and drives."""
    reset = course_calls(run, RESET)[0]
    _is_accepted(reset)
    arm, disarm = course_calls(run, ARM, at_least=6)[-2:]
    _commands(run, Window(sent_at(reset), sent_at(arm)), STOPPED, "after the reset, not armed yet")
    again = ("reset has to undo what the bump set: self.bumped = False. Still touching the wall isn't a "
             "new bump.")
    _is_accepted(arm, again)
    back = Window(sent_at(arm) + SOON, sent_at(disarm))
    _commands(run, back, MODES["back"], "in the mode back, armed after a reset")
    ends_with_a_stop(run, credit=0.5)


def _starts_with_no_other(run: Recording) -> None:
    """A program that is started with a mode that it doesn't know does not have it."""
    calls = [call for call in course_calls(run, GET, at_least=0) if call.response is not None]
    if any(response_fields(call).get("value") == STRANGE for call in calls):
        hint = ("The initial value is checked only if self.add_on_set_parameters_callback(self.check) comes "
                "before self.declare_parameter(...).")
        expected = f"no mode {STRANGE!r}, started with mode:={STRANGE}"
        raise Missed(expected, f"mode={STRANGE!r} at {calls[0].requested:.3g} s", hint, credit=0.5)


def _mode(call: Call) -> str:
    return str(plain(call.request).get("mode", ""))


def _phases(run: Recording) -> list[tuple[Call | None, Window]]:
    """The calls, each with the time until the next one; first no call, and the time before any."""
    calls = sorted((*run.calls_of(ARM), *run.calls_of(SET)), key=sent_at)
    begins = [0.0, *map(sent_at, calls)]
    ends = [*begins[1:], run.ended.stamp]
    phases = (Window(begin + SOON, end) for begin, end in zip(begins, ends, strict=True))
    return list(zip([None, *calls], phases, strict=True))


def _is_accepted(call: Call, guess: str = "") -> None:
    if not is_success(call):
        raise wrong_response(f"success=True for {call_text(call)}", call, guess)


def _commands(run: Recording, span: Window, wanted: Velocity, why: str, guess: str = UNARMED) -> None:
    """All commands are these. guess: for a robot that should stand.

    There the command before counts as well: a robot without a time-out goes on obeying it.
    """
    sent = span.before(span.end).rows(run.messages("/cmd_vel"))
    obeyed = None if any(wanted) else last_before(run.messages("/cmd_vel"), span.begin)
    sent = [obeyed, *sent] if obeyed else sent
    found = [(row.stamp, row.message.linear.x, row.message.angular.z) for row in sent]
    wrong = [it for it in found if not same(it[1:], wanted, 1e-3)]
    if wrong or (not found and any(wanted) and span.end - span.begin > SOON):
        at, v, w = wrong[0] if wrong else (span.begin, 0.0, 0.0)
        saw = f"({v:g} m/s, {w:g} rad/s) at {at:.3g} s" if wrong else f"no command from {at:.3g} s on"
        expected = f"({wanted[0]:g} m/s, {wanted[1]:g} rad/s) {why}"
        hint = DRIVE if any(wanted) else guess
        raise Missed(expected, saw, guess=hint, picture="path", unsafe=bool(wrong) and not any(wanted))
