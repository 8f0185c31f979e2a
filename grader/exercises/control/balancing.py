"""An exercise on P and D: a pole that stands, and a word about how long it stood where it can't."""

from __future__ import annotations

from grader.checks import Missed, fell_at, keeps_deadline, publishes, stands
from grader.checks.control import EFFORT
from grader.exercise import Exercise, Scenario
from grader.exercises.control.places import hopeless_cart, long_track
from sim.evidence import Recording

FLOAT = "std_msgs/msg/Float64"
STOOD = "/stood"
RATE, LIMIT = 100, 0.035  # Hz, s
EXACT, TRACKED = 0.03, 0.05  # s: of what is said, and how often the truth is written down
IN_TIME = (
    "Publish in the callback of /joint_states, which comes 100 times a second, and wait for nothing there."
)

balance = Exercise(
    "balance",
    "P falls, PD stands",
    scenarios=[
        Scenario(long_track, 10, seed=1, name="stands"),
        Scenario(long_track, 10, seed=2, name="stands"),
        Scenario(hopeless_cart, 4, seed=1, name="falls"),
    ],
)


@balance.check(2)
def pushes(run: Recording) -> None:
    """The node publishes efforts on /cart_effort."""
    publishes(run, EFFORT, FLOAT, at_least=5)


@balance.check(8, after=pushes, only="stands")
def keeps_it_up(run: Recording) -> None:
    """The pole stands for 10 s."""
    stands(run)


@balance.check(3, after=keeps_it_up, only="stands")
def pushes_in_time(run: Recording) -> None:
    """An effort comes at least every 0.035 s."""
    keeps_deadline(run, EFFORT, LIMIT, hint=IN_TIME)


@balance.check(2, after=keeps_it_up, only="stands")
def counts_while_it_stands(run: Recording) -> None:
    """With each joint state, /stood says how long the pole has stood, while it stands."""
    fell = fell_at(run)
    end = run.ended.stamp if fell is None else fell
    said = [heard for heard in publishes(run, STOOD, FLOAT) if heard.stamp < end]
    wrong = [heard for heard in said if abs(heard.message.data - heard.stamp) > EXACT]
    if wrong:
        stamp, told = wrong[0].stamp, wrong[0].message.data
        raise Missed(f"{stamp:.3g} s on {STOOD} at {stamp:.3g} s", f"{told:.3g}", _why_wrong(told, stamp))
    if len(said) < 0.9 * RATE * end:
        hint = "Publish it each time a joint state comes."
        raise Missed(f"{RATE} messages a second on {STOOD}", f"{len(said)} in {end:.3g} s", hint)


@balance.check(3, after=pushes, only="falls")
def keeps_how_long_it_stood(run: Recording) -> None:
    """Where the motor is too weak, /stood stays at how long the pole stood: until it leant by 0.5 rad."""
    fell = fell_at(run)
    if fell is None:
        raise Missed("a pole that falls", "it stood", "The motor of this cart is too weak to do that.")
    told = publishes(run, STOOD, FLOAT)[-1].message.data
    if not fell - TRACKED - EXACT <= told <= fell + EXACT:
        hint = (
            "It goes on counting: what has fallen has fallen."
            if abs(told - run.ended.stamp) < 0.1
            else _why_wrong(told, fell)
        )
        raise Missed(f"{fell:.2f} s on {STOOD} at last, within {TRACKED + EXACT:g} s", f"{told:.3g}", hint)


def _why_wrong(told: float, right: float) -> str:
    if told > 100 * right:
        return "In seconds, please."
    return "Count from the first joint state to the one at which the angle is beyond 0.5 rad, to either side."
