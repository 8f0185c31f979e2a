"""An exercise on P and D: a pole that stands, and a word about how long it stood where it can't."""

from __future__ import annotations

from grader.checks import Missed, fell_at, keeps_deadline, publishes, stands
from grader.checks.control import EFFORT, FALLEN
from grader.exercise import Exercise, Scenario
from grader.exercises.control.places import hopeless_cart, long_track
from sim.evidence import Recording

FLOAT = "std_msgs/msg/Float64"
LIMIT, EXACT = 0.035, 0.03  # s
IN_TIME = (
    "Publish in the callback of /joint_states, which comes 100 times a second, and wait for nothing there."
)

balance = Exercise(
    "balance",
    "P falls, PD stands",
    scenarios=[
        Scenario(long_track, 12, seed=1, name="stands"),
        Scenario(long_track, 12, seed=2, name="stands"),
        Scenario(hopeless_cart, 4, seed=1, name="falls"),
    ],
)


@balance.check(2)
def pushes(run: Recording) -> None:
    """The node publishes efforts on /cart_effort."""
    publishes(run, EFFORT, FLOAT, at_least=5)


@balance.check(8, after=pushes, only="stands")
def keeps_it_up(run: Recording) -> None:
    """The pole stands for 12 s."""
    stands(run)


@balance.check(3, after=keeps_it_up, only="stands")
def pushes_in_time(run: Recording) -> None:
    """An effort comes at least every 0.035 s."""
    keeps_deadline(run, EFFORT, LIMIT, hint=IN_TIME)


@balance.check(2, after=keeps_it_up, only="stands")
def says_nothing_while_it_stands(run: Recording) -> None:
    """While the pole stands, nothing is said on /fallen."""
    fell = fell_at(run)
    said = run.during(0.0, run.ended.stamp if fell is None else fell).messages("/fallen")
    if said:
        hint = "Say it when the angle is beyond 0.5 rad to either side, and not before."
        raise Missed("nothing on /fallen", f"{said[0].message.data:.3g} at {said[0].stamp:.3g} s", hint)


@balance.check(3, after=pushes, only="falls")
def tells_how_long_it_stood(run: Recording) -> None:
    """Where the motor is too weak, /fallen says once how long the pole stood: until it leant by 0.5 rad."""
    fell = fell_at(run)
    if fell is None:
        raise Missed(f"a pole that leans by {FALLEN:g} rad", "it stood", "The efforts were not the motor's.")
    said = [heard.message.data for heard in publishes(run, "/fallen", FLOAT)]
    expected = f"{fell:.2f} s on /fallen, within 0.05 s"
    if not fell - 0.05 - EXACT <= said[0] <= fell + EXACT:  # the truth is looked at every 0.05 s
        hint = (
            "In seconds, please."
            if said[0] > 100 * fell
            else "Count from the first joint state to the one at which the angle is beyond 0.5 rad."
        )
        raise Missed(expected, f"{said[0]:.3g}", hint)
    if len(said) > 1:
        raise Missed("one message", f"{len(said)}", "Remember that you have said it.")
