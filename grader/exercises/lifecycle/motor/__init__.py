"""A lifecycle node: it reads its parameter when it is configured, and drives only while it is active."""

import itertools
from typing import NamedTuple

from grader.checks import Missed, course_calls, hinting, named, serves
from grader.checks.services import is_refusal, is_success, sent_at
from grader.exercise import Exercise, Scenario
from grader.exercises.lifecycle.motor.motor_manager import (
    CHANGE,
    MOST_SPEED,
    SET,
    MotorManager,
    StrictManager,
)
from grader.geometry.near import is_near
from grader.responses import Window, require_standing
from grader.variants import Variants
from grader.worlds.trusting import trusting
from sim.evidence import Call, Message, Recording, Seconds

__all__ = ["MotorManager", "motor"]

OUT = "/cmd_vel"
SOON, BRAKING = 0.25, 0.4  # s: until the first command, and until the robot has stopped
FEWEST, MOST = 0.7, 1.2  # of the rate, in as short a time
CONFIGURE = 'In on_configure: self.speed = self.get_parameter("speed").value. And drive publishes self.speed.'
LATE = ("Read the speed in on_configure, and nowhere else: it holds until the node is configured again, "
        "whatever the parameter is set to in the meantime.")
DECLARE = ("Declare `speed` in __init__, so that it can be set before the node is configured: any value "
           "above 0 and up to 0.5, while the motor is at rest.")
SUCCESS = ("End the transition's method with `return TransitionCallbackReturn.SUCCESS`. And leave all "
           "transitions to the manager: a node that has configured itself can't be configured.")
RIGHT_SPEED = ("This speed is allowed, 0.5 m/s too. Was the node unconfigured again? After FAILURE it is; "
               "after ERROR, or an exception, only if on_error returns SUCCESS.")
STUCK = ("The transition's method hasn't returned: it waits, or is stuck in a loop. on_activate only creates "
         "the timer; `drive` publishes once each time it is called.")
SUPER = ("Create the timer in on_activate. And end that with `return super().on_activate(state)`: without "
         "it, a lifecycle publisher publishes nothing.")
ACTIVE = "Create the timer in on_activate, and destroy it in on_deactivate."
STRAIGHT = "Set linear.x and nothing else: the other fields of the Twist stay 0. To stop, send Twist()."
ZERO = ("Silence is not a stop: publish an empty Twist, before super().on_deactivate(state). After that, a "
        "lifecycle publisher publishes nothing.")
SHUTDOWN = ("A shutdown can come while the node is active, without a deactivate before it: on_shutdown, "
            "too, has to destroy the timer and stop the robot.")
AGAIN = ("It succeeded in the first round. Each method has to undo what its counterpart did: then the next "
         "round begins like the first one.")
PERIOD = "self.timer = self.create_timer({period}, self.drive) calls it {often} times a second."
UNDO = ("A timer is left over from before. What on_activate creates, on_deactivate destroys, and what "
        "on_configure creates, on_cleanup destroys: self.destroy_timer(self.timer).")
REFUSE = ("In on_configure, before anything is created: if the speed isn't above 0 and at most 0.5, return "
          "TransitionCallbackReturn.FAILURE.")

motor = Exercise("motor", "A motor that waits", scenarios=[
    Scenario(trusting("yard"), 11, 1, [MotorManager], name="rounds"),
    Scenario(trusting("yard"), 11, 4, [MotorManager], name="rounds"),
    Scenario(trusting("yard"), 7, 1, [StrictManager], name="refused"),
], variants=Variants(
    {"period": (0.1, 0.05, 0.2), "rate": (10, 20, 5), "often": ("ten", "twenty", "five")},
    texts=("{often} times a second", "create_timer({period}, "),
))


class Activation(NamedTuple):
    """A time in which the node is active; a transition takes the time until its response."""

    begin: Seconds  # the response to the request to activate it
    end: Seconds  # the request that ends it
    whole: Window  # from the request to activate it to the response to the one that ends it
    speed: float  # m/s, as it was configured


@motor.check(1)
def is_managed(run: Recording) -> None:
    """The node /motor is a lifecycle node."""
    named(run, "/motor")
    with hinting("Every LifecycleNode offers it: class Motor(LifecycleNode), not class Motor(Node)."):
        serves(run, CHANGE, "lifecycle_msgs/srv/ChangeState")


@motor.check(3, after=is_managed, only="rounds")
def drives_while_active(run: Recording) -> None:
    """While it is active, and only then, it publishes the speed on /cmd_vel."""
    for call in course_calls(run, CHANGE, at_least=2)[:2]:
        _is_accepted(call)
    active = _activations(run)
    changes = [moment for it in course_calls(run, SET) if (moment := it.requested or 0.0) > active[0].begin]
    _publishes_speed(run, active[0]._replace(end=changes[0] if changes else active[0].end), CONFIGURE)
    for row in run.messages(OUT):
        inside = any(one.whole.contains(row.stamp) for one in active)
        if not inside and not _is_command(row, 0.0):
            expected = f"no speed on {OUT} while /motor isn't active"
            hint = SHUTDOWN if row.stamp > active[-1].end else ACTIVE
            hint = hint if row.message.linear.x else STRAIGHT
            raise Missed(expected, _text_of(row), hint, picture="topics", unsafe=True)


@motor.check(2, after=drives_while_active, only="rounds")
def reads_the_speed_in_time(run: Recording) -> None:
    """The speed is that of the parameter when the node was configured, until it is configured again."""
    for one in _activations(run):
        _publishes_speed(run, one, LATE)


@motor.check(2, after=drives_while_active, only="rounds")
def stops(run: Recording) -> None:
    """When it is deactivated or shut down, it stops the robot with a zero command."""
    active = _activations(run)
    for one, then in zip(active, [*(it.whole.begin for it in active[1:]), run.ended.stamp], strict=True):
        why = f"{BRAKING:g} s after the request at {one.end:.3g} s"
        require_standing(run, Window(one.end + BRAKING, then), why, ZERO)


@motor.check(2, after=drives_while_active, only="rounds")
def cleans_up(run: Recording) -> None:
    """All transitions succeed in the second round, too, and each time it publishes ten times a second."""
    for call in course_calls(run, CHANGE, at_least=9):
        _is_accepted(call, hint=AGAIN)
    for one in _activations(run):
        sent = Window(one.begin, one.end).rows(run.messages(OUT))
        rate = len(sent) / (one.end - one.begin)
        wanted = motor.drawn.rate
        if not FEWEST * wanted <= rate <= MOST * wanted:
            expected = f"{wanted} Hz on {OUT} in the activation at {one.begin:.3g} s"
            again = one.begin > _activations(run)[0].begin
            raise Missed(expected, f"{rate:.2g} Hz", UNDO if again else PERIOD.format(**vars(motor.drawn)))


@motor.check(2, after=is_managed, only="refused")
def refuses_a_wrong_speed(run: Recording) -> None:
    """With a speed that isn't above 0 and at most 0.5 m/s it can't be configured, with another one it can."""
    for call in course_calls(run, CHANGE, at_least=5):
        wanted = _settings(run, call)[-1]
        text = f", with the speed {_value(wanted):.2g} m/s"
        if _label(call) == "configure" and not 0.0 < _value(wanted) <= MOST_SPEED:
            if not is_refusal(call) and not _is_refused(wanted):
                expected = f"success=False for {_text(call)}{text}"
                raise Missed(expected, "no answer" if call.response is None else "success=True", REFUSE)
            whole = Window(sent_at(call), call.answered or run.ended.stamp)
            raised = next((error for error in run.errors if whole.contains(error.stamp)), None)
            if raised:
                expected = f"FAILURE for {_text(call)}{text}"
                raise Missed(expected, f"an exception, {raised.type}", REFUSE)
        elif _label(call) in ("configure", "activate"):
            _speed(run, call)
            _is_accepted(call, text, RIGHT_SPEED)


def _label(call: Call) -> str:
    return str(call.request.transition.label)


def _settings(run: Recording, call: Call) -> list[Call]:
    """The requests to set the parameter before a call."""
    return [it for it in course_calls(run, SET) if (it.requested or 0.0) < (call.requested or 0.0)]


def _value(setting: Call) -> float:
    return float(setting.request.parameters[0].value.double_value)


def _is_refused(setting: Call) -> bool:
    return setting.response is not None and not setting.response.results[0].successful


def _speed(run: Recording, call: Call) -> float:
    """Return the parameter's value at a call. Raises Missed if the node has refused every one so far."""
    asked = _settings(run, call)
    done = [_value(it) for it in asked if not _is_refused(it)]
    if not done:
        expected = f"the parameter speed of /motor set to {_value(asked[-1]):.3g} m/s"
        raise Missed(expected, f"refused: {asked[-1].response.results[0].reason}", DECLARE)
    return done[-1]


def _text(call: Call) -> str:
    return f"{_label(call)} at {call.requested:.3g} s"


def _is_accepted(call: Call, why: str = "", hint: str = SUCCESS) -> None:
    if not is_success(call):
        answered = call.response is not None
        saw = "success=False" if answered else "no answer"
        raise Missed(f"success=True for {_text(call)}{why}", saw, hint if answered else STUCK)


def _activations(run: Recording) -> list[Activation]:
    """Return the times in which it is active: from each activate that succeeds to what comes next."""
    calls = course_calls(run, CHANGE, at_least=9)
    configured, found = 0.0, []
    for call, following in itertools.pairwise(calls):
        if _label(call) == "configure":
            configured = _speed(run, call)
        if _label(call) == "activate" and is_success(call):
            asked, end = call.requested or 0.0, following.requested or 0.0
            whole = Window(asked, end if following.answered is None else following.answered)
            found.append(Activation(call.answered or asked, end, whole, configured))
    return found


def _publishes_speed(run: Recording, one: Activation, guess: str) -> None:
    sent = Window(one.begin + SOON, one.end).before(one.end).rows(run.messages(OUT))
    wrong = [row for row in sent if not _is_command(row, one.speed)]
    if wrong or not sent:
        saw = _text_of(wrong[0]) if wrong else "no command"
        straight = wrong and is_near(wrong[0].message.linear.x, one.speed, 1e-3)
        guess = STRAIGHT if straight else guess
        expected = f"{one.speed:.3g} m/s on {OUT}, active from {one.begin:.3g} to {one.end:.3g} s"
        raise Missed(expected, saw, guess if wrong else SUPER)


def _is_command(row: Message, speed: float) -> bool:
    command = row.message
    return is_near((command.linear.x, command.angular.z), (speed, 0.0), 1e-3)


def _text_of(row: Message) -> str:
    turn = f" and {row.message.angular.z:.3g} rad/s" if row.message.angular.z else ""
    return f"{row.message.linear.x:.3g} m/s{turn} at {row.stamp:.3g} s"
