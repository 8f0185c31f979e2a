"""Exercises on parameters: a speed that can be set, but not to anything, and a start with another one."""

from __future__ import annotations

import math

from grader.checks import Missed, check, named, publishes, series
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.services.calls import Call, accepted, asked, calls, not_so, refused
from grader.exercises.services.partners import Reader, Tuner
from sim.recording import Recording

GET, SET = "/cruiser/get_parameters", "/cruiser/set_parameters"
LOW, HIGH, DEFAULT, LAUNCHED = 0.0, 0.5, 0.2, 0.3  # m/s
SETTINGS = 7  # that the tuner makes


@check(points=2)
def declares_speed(recording: Recording) -> None:
    """The node /cruiser has a parameter `speed`, a number with a decimal point."""
    named(recording, "/cruiser")
    call = asked(recording, GET)[0]
    if not isinstance(call.response.get("value"), float):
        saw = "no such parameter, or one of another kind" if call.response else "no answer"
        hint = 'In __init__: self.declare_parameter("speed", 0.2). Its kind is that of the default.'
        with advising(recording, hint):
            raise Missed("a parameter `speed` of /cruiser with a value such as 0.2", saw)


@check(points=2, after=declares_speed)
def begins_with_its_default(recording: Recording) -> None:
    """As long as nobody sets it the speed is 0.2, and the robot drives with that."""
    _begins_with(recording, DEFAULT, 'The default: self.declare_parameter("speed", 0.2).')


@check(points=4, after=declares_speed)
def follows_the_setting(recording: Recording) -> None:
    """A new speed holds at once: on /cmd_vel, linear.x is what the parameter says."""
    made = asked(recording, SET, SETTINGS)
    for call in (call for call in made if _is_allowed(call)):
        if not accepted(call):
            expected = f"successful=True for {call.question}"
            hint = (
                f"A speed from {LOW} to {HIGH}, both ends included, is fine. Look at the new one, in "
                "parameter.value, and return SetParametersResult(successful=True)."
            )
            not_so(recording, expected, call, hint)
        later = [other.asked for other in made if other.asked > call.asked]
        _drives_at(recording, call.request["speed"], call.asked + 0.3, min(later, default=math.inf))


@check(points=4, after=declares_speed)
def refuses_other_speeds(recording: Recording) -> None:
    """A speed below 0.0 or above 0.5 is refused with a reason, and changes nothing."""
    for call in asked(recording, SET, SETTINGS):
        if _is_allowed(call):
            continue
        expected = f"successful=False and a reason for {call.question}"
        if not refused(call):
            not_so(recording, expected, call, _refusing_hint(recording))
        if not call.response["reason"].strip():
            why = 'Say why: SetParametersResult(successful=False, reason="...").'
            not_so(recording, expected, call, why, credit=0.6)


def _refusing_hint(recording: Recording) -> str:
    if any(refused(call) for call in asked(recording, SET) if not _is_allowed(call)):
        return f"The range has two ends: refuse a value unless {LOW} <= parameter.value <= {HIGH}."
    return (
        "Nothing was refused. Is the method handed over, self.add_on_set_parameters_callback(self.check)? "
        "And does it refuse where parameter.name is `speed`, unless "
        f"{LOW} <= parameter.value <= {HIGH}?"
    )


def _is_allowed(call: Call) -> bool:
    return LOW <= call.request["speed"] <= HIGH


def _begins_with(recording: Recording, speed: float, hint: str) -> None:
    """The parameter has this value at the start, and the commands, too."""
    read = asked(recording, GET)[0]
    value = read.response["value"]
    if not math.isclose(value, speed):
        raise Missed(f"speed {speed} from the start", f"{value:g}", hint)
    later = [call.asked for call in calls(recording, SET)]
    _drives_at(recording, speed, 0.5, min(later, default=math.inf))


def _drives_at(recording: Recording, speed: float, begin: float, end: float) -> None:
    """The commands between two moments have this speed."""
    publishes(recording, "/cmd_vel", "geometry_msgs/msg/Twist")
    values = [(at, x) for at, x in series(recording, "/cmd_vel", "linear.x") if begin <= at < end]
    other = [(at, x) for at, x in values if abs(x - speed) > 1e-6]
    if other or not values:
        saw = f"{other[0][1]:g} m/s at {other[0][0]:.3g} s" if other else "no command"
        hint = (
            "Ask for the value each time you need it, in drive: "
            'self.get_parameter("speed").value. One that is read in __init__ never changes.'
        )
        raise Missed(f"linear.x {speed:g} m/s on /cmd_vel from {begin:.3g} s on", saw, hint, picture="topics")


parameters = Exercise(
    "parameters",
    "A speed that can be set",
    [declares_speed, begins_with_its_default, follows_the_setting, refuses_other_speeds],
    world="yard",
    seconds=14,
    companions=[Tuner],
    seeds=(1, 2),
)


@check(points=1)
def launches_the_cruiser(recording: Recording) -> None:
    """The node /cruiser runs, and has its parameter `speed`."""
    if not set(recording.graph.nodes) - {"/robot", "/reader"}:
        hint = "launch hands back what is to be started: return Process(...), with Cruiser in it."
        raise Missed("a node called /cruiser", "no node was started", hint)
    declares_speed(recording)


@check(points=2, after=launches_the_cruiser)
def is_launched_with_a_speed(recording: Recording) -> None:
    """It is started with a speed of 0.3, and drives with that."""
    _begins_with(recording, LAUNCHED, 'In launch: return Process(Cruiser, parameters={"speed": 0.3}).')


launch = Exercise(
    "launch",
    "The same node, with another speed",
    [launches_the_cruiser, is_launched_with_a_speed],
    world="yard",
    seconds=4,
    companions=[Reader],
)
