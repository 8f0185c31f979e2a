"""A speed that can be set within limits, and a node that is started with another one."""

import math
from functools import partial

from grader.checks import Missed, course_calls, named, publishes, series, wrong_response
from grader.checks.fields import plain
from grader.checks.services import call_text, is_refusal, is_success, response_fields, sent_at
from grader.companions.parameter_start import started_with
from grader.companions.service_clients import Tuner
from grader.exercise import Exercise, Scenario
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Call, Recording, Seconds

GET, SET = "/cruiser/get_parameters", "/cruiser/set_parameters"
LOW, HIGH = 0.0, 0.5  # m/s
SETTINGS = 7  # that the tuner makes
INSIDE = f"{LOW} <= parameter.value <= {HIGH}"

TOO_FAST = 0.9  # m/s, with which it is started once

parameters = Exercise("parameters", "A speed that can be set", scenarios=[
    Scenario("yard", 14, 1, [Tuner], name="tuned"), Scenario("yard", 14, 2, [Tuner], name="tuned"),
    Scenario("yard", 2, name="too fast", prepare=partial(started_with, "speed", TOO_FAST)),  # type: ignore[arg-type]  # the program comes first
], variants=Variants(
    {"speed": (0.2, 0.15, 0.25)},
    texts=("with {speed:g} (m/s)", '"speed", {speed:g})', "begin at {speed:g}", "the speed is {speed:g}"),
))


@parameters.check(2, only="tuned")
def declares_speed(run: Recording) -> float:
    """The node /cruiser has a parameter `speed`, a number with a decimal point."""
    named(run, "/cruiser")
    given = response_fields(course_calls(run, GET)[0])
    if not isinstance(value := given.get("value"), float):
        expected = "a parameter `speed` of /cruiser with a value such as 0.2"
        raise Missed(expected, "no such parameter, or one of another type" if given else "no answer")
    return value


@parameters.check(2, after=declares_speed, only="tuned")
def begins_with_its_default(run: Recording, speed: float) -> None:
    """Until it is set, the speed is 0.2, and the robot drives at that speed."""
    default = parameters.drawn.speed
    begins_with(run, speed, default, f'The default: self.declare_parameter("speed", {default}).')


@parameters.check(4, after=declares_speed, only="tuned")
def follows_the_setting(run: Recording) -> None:
    """A new speed takes effect at once: linear.x on /cmd_vel is the parameter's value."""
    made = course_calls(run, SET, SETTINGS)
    for call in filter(_is_allowed, made):
        if not is_success(call):
            guess = (f"A speed from {LOW} to {HIGH}, both ends included, is fine. Compare the new one, "
                     "parameter.value, and return SetParametersResult(successful=True).")
            raise wrong_response(f"successful=True for {call_text(call)}", call, guess)
        later = [stamp for stamp in map(sent_at, made) if stamp > sent_at(call)]
        _drives_at(run, _speed(call), sent_at(call) + 0.3, min(later, default=math.inf))


@parameters.check(4, after=declares_speed)
def refuses_other_speeds(run: Recording) -> None:
    """A speed below 0.0 or above 0.5 is refused with a reason, and changes nothing, at the start as well."""
    if not run.calls_of(SET):  # not set in this run
        _starts_with_no_other(run)
        return
    others = [call for call in course_calls(run, SET, SETTINGS) if not _is_allowed(call)]
    for call in others:
        expected = f"successful=False and a reason for {call_text(call)}"
        if not is_refusal(call):
            guess = ("Nothing was refused. Did you register the method, "
                     "self.add_on_set_parameters_callback(self.check)? And does it refuse when "
                     "parameter.name is `speed`, "
                     f"unless {INSIDE}?")
            if _is_cut(run, call):
                guess = (
                    "Clipping a value to the range doesn't reject it: the request succeeds, "
                    "and the robot does something else. Return SetParametersResult(successful=False, "
                    'reason="...").'
                )
            if any(map(is_refusal, others)):
                guess = f"The range has two ends: refuse a value unless {INSIDE}."
            raise wrong_response(expected, call, guess)
        if not response_fields(call)["reason"].strip():
            guess = 'Give a reason: SetParametersResult(successful=False, reason="...").'
            raise wrong_response(expected, call, guess, credit=0.6)


def _starts_with_no_other(run: Recording) -> None:
    """A program that is started with a speed beyond the range does not drive with it."""
    commands = [row for row in run.messages("/cmd_vel") if row.type == "geometry_msgs/msg/Twist"]
    driven = [(row.stamp, x) for row in commands if not LOW <= (x := row.message.linear.x) <= HIGH]
    if driven:
        expected = f"no speed beyond {HIGH} m/s, started with speed:={TOO_FAST}"
        hint = ("The initial value is checked only if self.add_on_set_parameters_callback(self.check) comes "
                "before self.declare_parameter(...).")
        raise Missed(expected, f"{driven[0][1]:g} m/s at {driven[0][0]:.3g} s", hint, credit=0.5)


def _speed(call: Call) -> float:
    return float(plain(call.request)["speed"])


def _is_allowed(call: Call) -> bool:
    return LOW <= _speed(call) <= HIGH


def _is_cut(run: Recording, call: Call) -> bool:
    """Return whether a speed was accepted, and the robot drove at the nearest one that is allowed."""
    soon = series(run.during(sent_at(call) + 0.3, sent_at(call) + 1.3), "/cmd_vel", "linear.x")
    limit = min(max(_speed(call), LOW), HIGH)
    return is_success(call) and bool(soon) and all(abs(speed - limit) < 1e-6 for _, speed in soon)


def begins_with(run: Recording, speed: float, expected: float, hint: str = "") -> None:
    """The parameter has the expected value at the start, and the commands, too."""
    if not math.isclose(speed, expected):
        raise Missed(f"speed {expected} from the start", f"{speed:g}", hint)
    later = map(sent_at, course_calls(run, SET, at_least=0))
    _drives_at(run, expected, 0.5, min(later, default=math.inf))


def _drives_at(run: Recording, speed: float, begin: Seconds, end: Seconds) -> None:
    """The commands between two moments have this speed."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    values = series(run.during(begin, end), "/cmd_vel", "linear.x")
    other = [(at, x) for at, x in values if not is_near(x, speed, 1e-6)]
    if other or not values:
        saw = f"{other[0][1]:g} m/s at {other[0][0]:.3g} s" if other else "no command"
        hint = (
            "Look the value up each time you need it, in drive: "
            'self.get_parameter("speed").value. A value read in __init__ never changes.'
        )
        raise Missed(f"linear.x {speed:g} m/s on /cmd_vel from {begin:.3g} s on", saw, hint, picture="topics")
