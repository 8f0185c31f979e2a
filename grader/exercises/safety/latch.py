"""An emergency stop: what has stopped stays stopped, until it is reset."""

import itertools
from typing import NamedTuple

from grader.checks import Missed, publishes, serves, subscribes
from grader.checks.no_data import no_data
from grader.checks.services import sent_at
from grader.checks.twists import OUT, SAME, TWIST, speeds, speeds_text
from grader.companions.drivers import BUTTON, RAW, RESET, EmergencyOperator
from grader.exercise import Exercise, Scenario
from grader.responses import Window, from_course, requests_from_course, require_standing, same
from grader.worlds.trusting import trusting
from sim.evidence import Call, Recording, Seconds
from sim.network import Network

SOON, BRAKING, DEAF = 0.1, 0.4, 1.0  # s: to pass on, to stop, and to stop when the button is silent
LATELY = 0.25  # s, for which a command may be repeated
LATCH = ("The stop ended by itself. Store in self.stopped that the button was pressed: only /reset may "
         "set that to False again, not a False from the button.")
BROKEN = ("A broken cable counts as pressed: as long as the button is silent, refuse /reset. Check the age "
          "of the button's last message in reset, too, not only in the timer.")

RADIO = Network(delay=0.05, jitter=0.04)  # s; between the student's laptop and the robot


latch = Exercise("latch", "An emergency stop that latches", scenarios=[
    Scenario("yard", 14, 1, [EmergencyOperator]),
    Scenario(trusting("yard"), 14, 2, [EmergencyOperator], network=RADIO),
])


class Times(NamedTuple):
    """The times of the operator's actions."""

    press: Seconds
    release: Seconds
    quiet: Seconds  # the driver's last command
    resumed: Seconds  # and the first one after it
    cut: Seconds  # the button's last message before its cable was cut


@latch.check(3,
             guess="Create two subscriptions, a publisher for the robot, and create_service(Trigger, ...).")
def stands_between(run: Recording) -> None:
    """The node subscribes to /cmd_vel_raw and /emergency, offers /reset (Trigger) and publishes /cmd_vel."""
    subscribes(run, RAW, TWIST)
    subscribes(run, BUTTON, "std_msgs/msg/Bool")
    serves(run, RESET, "std_srvs/srv/Trigger")
    publishes(run, OUT, TWIST)


@latch.check(4, after=stands_between)
def lets_through(run: Recording) -> None:
    """While it is not stopped, each command passes unchanged: at the beginning, and after the reset."""
    when, sent, raw = _times(run), publishes(run, OUT, TWIST), from_course(run, RAW, at_least=10)
    for command in raw:
        wanted, then = speeds(command), Window.after(command.stamp, SOON).rows(sent)
        if _is_free(command.stamp, when) and not any(same(speeds(row), wanted, SAME) for row in then):
            saw = speeds_text(speeds(then[0])) if then else "nothing"
            expected = f"{speeds_text(wanted)} on {OUT} at {command.stamp:.3g} s, as on {RAW}"
            hint = "Publish the command itself in the callback of /cmd_vel_raw, unless self.stopped."
            if command.stamp >= when.resumed:
                hint = "It was reset, and the button is out: now commands should pass again."
            raise Missed(expected, saw, hint)
    for row in sent:
        if _is_free(row.stamp, when) and _is_free(row.stamp - SOON, when):
            lately = Window(row.stamp - LATELY, row.stamp).rows(raw)
            if not any(same(speeds(row), speeds(command), SAME) for command in lately):
                hint = "Publish the commands as they arrive, and no others between them."
                expected = f"only what came on {RAW}, on {OUT} at {row.stamp:.3g} s"
                raise Missed(expected, speeds_text(speeds(row)), hint)


@latch.check(4, after=lets_through)
def stops(run: Recording) -> None:
    """When the button is pressed, the robot stops within 0.4 s, and stays stopped while the button is in."""
    when = _times(run)
    hint = "Publish an empty Twist as soon as the button sends True, and pass nothing on while self.stopped."
    pressed = Window(when.press + BRAKING, min(when.release, sent_at(requests_from_course(run, RESET)[0])))
    require_standing(run, pressed, f"{BRAKING:g} s after the button was pressed", hint)


@latch.check(4, after=stops)
def stays_stopped(run: Recording) -> None:
    """It stays stopped when the button is released, whatever the driver sends, until it is reset."""
    when = _times(run)
    released = Window(when.release, sent_at(_granted(run)))
    require_standing(run, released, f"after the button was released at {when.release:.3g} s", LATCH)


@latch.check(3, after=stops)
def answers_resets(run: Recording) -> None:
    """/reset is refused while the button is in or silent (success=False), else granted (success=True)."""
    granted, cut = _granted(run), _times(run).cut
    for call in requests_from_course(run, RESET):
        broken, released = sent_at(call) > cut, sent_at(call) >= sent_at(granted)
        right = released and not broken
        if call.response is None or call.response.success is not right:
            saw = "no answer" if call.response is None else f"success={call.response.success}"
            state = "'s cable broken" if broken else " released" if released else " still in"
            hint = ("Check self.pressed: response.success is whether the reset was possible. And return the "
                    "response.")
            expected = f"success={right} at {call.requested:.3g} s, with the button{state}"
            granted_unsafely = call.response is not None and call.response.success
            raise Missed(expected, saw, BROKEN if broken else hint, unsafe=granted_unsafely)
    refused, release = sent_at(requests_from_course(run, RESET)[0]), _times(run).release
    hint = "A refused reset changes nothing: self.stopped stays True as long as the button is in."
    require_standing(run, Window(refused, release), f"after the refused reset at {refused:.3g} s", hint)


@latch.check(2, after=(lets_through, stays_stopped))
def forgets_the_old_speed(run: Recording) -> None:
    """After the reset the robot stays where it is until a new command comes."""
    when, reset = _times(run), sent_at(_granted(run))
    hint = "The command from before the stop is out of date: a reset must not move the robot by itself."
    why = f"from the reset at {reset:.3g} s to the next command"
    require_standing(run, Window(reset, when.resumed), why, hint)


@latch.check(2, after=lets_through)
def stops_without_the_button(run: Recording) -> None:
    """A button that is silent for 0.5 s counts as pressed: the robot stops within 1 s of its last message."""
    when = _times(run)
    hint = "A broken cable can't send True. Let a timer check how long ago the button's last message arrived."
    resets = [call for call in requests_from_course(run, RESET) if sent_at(call) > when.cut]
    asked = sent_at(resets[0]) if resets else when.cut + DEAF
    require_standing(run, Window(when.cut + DEAF, asked), f"{DEAF:g} s after the button's last message", hint)
    hint = BROKEN if any(call.response and call.response.success for call in resets) else LATCH
    require_standing(run, Window(asked, run.ended.stamp), "until it is reset", hint)


def _times(run: Recording) -> Times:
    button, commands = from_course(run, BUTTON, at_least=10), from_course(run, RAW)
    pressed = [row.stamp for row in button if row.message.data]
    cuts, pauses = _pauses([row.stamp for row in button]), _pauses([row.stamp for row in commands])
    if not (pressed and cuts and pauses):
        raise no_data(run, "a stop, a reset and a broken cable", "less", run.graph.publishers(BUTTON))
    return Times(pressed[0], pressed[-1] + 0.1, *pauses[0], cuts[0][0])


def _pauses(stamps: list[Seconds]) -> list[tuple[Seconds, Seconds]]:
    return [(before, after) for before, after in itertools.pairwise(stamps) if after - before > 1.0]


def _is_free(stamp: Seconds, when: Times) -> bool:
    """Return whether nothing stops the robot at that moment, for certain; a press may overtake a command."""
    return 0.5 < stamp < when.press - SOON or when.resumed <= stamp < when.cut + 0.3


def _granted(run: Recording) -> Call:
    """The call that comes when the button is released; there is one before it or two, and one after it."""
    made, release = requests_from_course(run, RESET), _times(run).release
    after = [call for call in made if sent_at(call) > release]
    if not after or len(made) < 2:
        raise no_data(run, f"two calls of {RESET}", f"{len(made)}", run.graph.ends("client", RESET))
    return after[0]
