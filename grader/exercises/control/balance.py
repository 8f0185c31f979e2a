"""P and D: keep a pole up, and publish how long it stood where that is impossible."""

from grader.checks import Missed, fell_at, hinting, keeps_deadline, otherwise, publishes, stands
from grader.checks.control import EFFORT
from grader.exercise import Exercise, Scenario
from grader.geometry.near import is_near
from grader.responses import same
from grader.worlds.carts import hopeless_cart, long_track
from sim.evidence import Recording

FLOAT, STOOD = "std_msgs/msg/Float64", "/stood"
RATE, LIMIT = 100, 0.035  # Hz, s
EXACT, TRACKED = 0.03, 0.05  # s: of what is published, and how often the truth is recorded
WRONG_TIME = {
    "That is not in seconds: publish the time in seconds.": lambda run, stood, right: stood > 100 * right,
    "Measure from the first joint state to the one at which the angle exceeds 0.5 rad, to either side.":
        otherwise,
}

balance = Exercise("balance", "P falls, PD stands", scenarios=[
    Scenario(long_track, 10, seed=1, waits=False, name="stands"),
    Scenario(long_track, 10, seed=2, waits=False, name="stands"),
    Scenario(hopeless_cart, 4, seed=1, waits=False, name="falls"),
])


@balance.check(2)
def pushes(run: Recording) -> None:
    """The node publishes efforts on /cart_effort."""
    publishes(run, EFFORT, FLOAT, at_least=5)


@balance.check(8, after=pushes, only="stands")
def keeps_it_up(run: Recording) -> None:
    """The pole stays up for 10 s."""
    stands(run)


@balance.check(3, after=keeps_it_up, only="stands")
def pushes_in_time(run: Recording) -> None:
    """An effort comes at least every 0.035 s."""
    with hinting("Publish in the callback of /joint_states, which runs 100 times a second, and never wait "
                 "in it."):
        keeps_deadline(run, EFFORT, LIMIT)


@balance.check(2, after=keeps_it_up, only="stands", hints=WRONG_TIME)
def counts_while_it_stands(run: Recording) -> None:
    """With each joint state, /stood gives how long the pole has stood, as long as it stands."""
    end = fell_at(run) or run.ended.stamp
    sent = [row for row in publishes(run, STOOD, FLOAT) if row.stamp < end]
    for row in sent:
        if not is_near(row.message.data, row.stamp, EXACT):
            expected = f"{row.stamp:.3g} s on {STOOD} at {row.stamp:.3g} s"
            raise Missed(expected, f"{row.message.data:.3g}", about=(row.message.data, row.stamp))
    if len(sent) < 0.9 * RATE * end:
        hint = "Publish it each time a joint state arrives."
        raise Missed(f"{RATE} messages a second on {STOOD}", f"{len(sent)} in {end:.3g} s", hint)


@balance.check(3, after=pushes, only="falls", hints={
    "It keeps counting after the fall: once the pole has fallen, stop the count for good.":
        lambda run, stood, fell: same(stood, run.ended.stamp, 0.1),
    **WRONG_TIME,
})
def keeps_how_long_it_stood(run: Recording) -> None:
    """If the motor is too weak, /stood stays at the time the pole stood, until it leaned by 0.5 rad."""
    fell = fell_at(run)
    if fell is None:
        raise Missed("a pole that falls", "it stood")
    stood = publishes(run, STOOD, FLOAT)[-1].message.data
    if not fell - TRACKED - EXACT <= stood <= fell + EXACT:
        expected = f"{fell:.2f} s as the last value on {STOOD}, within {TRACKED + EXACT:g} s"
        raise Missed(expected, f"{stood:.3g}", about=(stood, fell))
