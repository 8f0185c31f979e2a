"""An exercise on an emergency stop: what stopped stays stopped, until somebody says that all is well."""

from __future__ import annotations

import itertools
from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, serves, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.safety.moving import OUT, TWIST, alike, must_stand, ours, speeds, told
from grader.exercises.safety.partners import BUTTON, RAW, RESET, Operator
from sim.evidence import Call, Recording, Seconds

SOON, BRAKING, DEAF = 0.1, 0.4, 1.0  # s: to pass on, to stand, and to stand where the button is silent
LATELY = 0.25  # s, for which a command may be said again
LATCH = (
    "It let go by itself. Remember in self.stopped that it was pressed: only /reset may make that False "
    "again, and not a False from the button."
)

latch = Exercise(
    "latch", "An emergency stop that stays", world="yard", seconds=14, companions=[Operator], seeds=(1, 2)
)


class Times(NamedTuple):
    """What our operator did, and when."""

    press: Seconds
    release: Seconds
    quiet: Seconds  # the driver's last command
    speak: Seconds  # and the first one after it
    cut: Seconds  # the button's last word before its cable was broken


@latch.check(3)
def stands_between(run: Recording) -> None:
    """The node hears /cmd_vel_raw and /emergency, serves /reset (Trigger), and publishes on /cmd_vel."""
    with hinting(guess="Two subscriptions, a publisher for the robot, and create_service(Trigger, ...)."):
        subscribes(run, RAW, TWIST)
        subscribes(run, BUTTON, "std_msgs/msg/Bool")
        serves(run, RESET, "std_srvs/srv/Trigger")
        publishes(run, OUT, TWIST)


@latch.check(4, after=stands_between)
def lets_through(run: Recording) -> None:
    """While it is not stopped, each command passes as it is: in the beginning, and after the reset."""
    when, sent, raw = _times(run), publishes(run, OUT, TWIST), ours(run, RAW, at_least=10)
    for command in raw:
        if not _is_free(command.stamp, when):
            continue
        wish = speeds(command)
        then = [one for one in sent if command.stamp - 1e-6 <= one.stamp <= command.stamp + SOON]
        if not any(alike(speeds(one), wish) for one in then):
            saw = told(speeds(then[0])) if then else "nothing"
            raise Missed(
                f"{told(wish)} on {OUT} at {command.stamp:.3g} s, as on {RAW}",
                saw,
                _why_held(command.stamp, when),
            )
    for one in sent:
        if _is_free(one.stamp, when) and _is_free(one.stamp - SOON, when):
            lately = [speeds(it) for it in raw if one.stamp - LATELY <= it.stamp <= one.stamp]
            if not any(alike(speeds(one), wish) for wish in lately):
                hint = "Publish the commands as they come, and no other between them."
                expected = f"only what came on {RAW}, on {OUT} at {one.stamp:.3g} s"
                raise Missed(expected, told(speeds(one)), hint)


@latch.check(4, after=lets_through)
def stops(run: Recording) -> None:
    """When the button is pressed, the robot stands within 0.4 s, as long as it is in."""
    when = _times(run)
    hint = "Publish an empty Twist as soon as the button says True, and pass nothing on while it is stopped."
    must_stand(run, when.press + BRAKING, when.release, f"{BRAKING:g} s after the button was pressed", hint)


@latch.check(4, after=stops)
def stays_stopped(run: Recording) -> None:
    """It stays so when the button is let go, whatever the driver says, until it is reset."""
    when = _times(run)
    must_stand(
        run,
        when.release,
        _granted(run).requested,
        f"after the button was let go at {when.release:.3g} s",
        LATCH,
    )


@latch.check(3, after=stops)
def answers(run: Recording) -> None:
    """/reset is refused while the button is in (success=False), and granted afterwards (success=True)."""
    granted = _granted(run)
    for call in _resets(run):
        right = call.requested >= granted.requested
        if call.response is None or call.response.success is not right:
            saw = "no answer" if call.response is None else f"success={call.response.success}"
            state = "let go" if right else "still in"
            hint = "response.success says whether it could be done; return the response. Ask self.pressed."
            raise Missed(f"success={right} at {call.requested:.3g} s, with the button {state}", saw, hint)


@latch.check(2, after=(lets_through, stays_stopped))
def forgets_the_old_speed(run: Recording) -> None:
    """After the reset the robot stands until a new command comes."""
    when, reset = _times(run), _granted(run).requested
    hint = "The command from before the stop is out of date: a reset lets go, and moves nothing by itself."
    must_stand(run, reset, when.speak, f"from the reset at {reset:.3g} s to the next command", hint)


@latch.check(2, after=lets_through)
def trusts_no_silence(run: Recording) -> None:
    """A button that is silent for 0.5 s counts as pressed: the robot stands 1 s after its last word."""
    when = _times(run)
    hint = "A broken cable can't say True. A timer looks at how long ago the button said something."
    must_stand(run, when.cut + DEAF, when.cut + 1.5, f"{DEAF:g} s after the button's last word", hint)
    must_stand(run, when.cut + 1.5, run.ended.stamp, "until somebody resets it", LATCH)


def _times(run: Recording) -> Times:
    pressed = [heard.stamp for heard in ours(run, BUTTON, at_least=10) if heard.message.data]
    button, commands = [[one.stamp for one in ours(run, topic)] for topic in (BUTTON, RAW)]
    cuts = [a for a, b in itertools.pairwise(button) if b - a > 1.0]
    pauses = [(a, b) for a, b in itertools.pairwise(commands) if b - a > 1.0]
    if not (pressed and cuts and pauses):
        raise no_data(run, "a stop, a reset and a broken cable", "less", run.graph.publishers(BUTTON))
    return Times(pressed[0], pressed[-1] + 0.1, *pauses[0], cuts[0])


def _is_free(stamp: Seconds, when: Times) -> bool:
    """Whether nothing stops the robot at that moment, for sure."""
    return 0.5 < stamp < when.press - 1e-6 or when.speak <= stamp < when.cut + 0.3


def _resets(run: Recording) -> list[Call]:
    """Our calls."""
    return [call for call in run.calls_of(RESET) if call.requested_by_course and call.requested is not None]


def _granted(run: Recording) -> Call:
    """The one that comes when the button is out; there is one before it or two."""
    asked, release = _resets(run), _times(run).release
    after = [call for call in asked if call.requested > release]
    if not after or len(asked) < 2:
        raise no_data(run, f"two calls of {RESET}", f"{len(asked)}", run.graph.ends("client", RESET))
    return after[0]


def _why_held(stamp: Seconds, when: Times) -> str:
    if stamp >= when.speak:
        return "It was reset, and the button is out: then commands should pass again."
    return "Publish the command itself in the callback of /cmd_vel_raw, unless self.stopped."
