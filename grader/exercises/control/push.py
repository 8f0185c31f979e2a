"""A design exercise: keep a pole up with other masses, another pole, and pushes."""

from grader.checks import Missed, hinting, keeps_to_limits, lean, publishes, settles, stands, still_stands
from grader.checks.control import EFFORT
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.worlds.carts import pushed_cart
from sim.evidence import Recording

LIMIT = 10.0  # N
SOON, NEAR, STEADY = 3.0, 0.05, 0.05  # s, m, rad

push = Exercise("push", "Whatever comes, your way", world=pushed_cart, seconds=19, seeds=(1, 2), waits=False)


@push.check(2)
def pushes(run: Recording) -> None:
    """The node publishes efforts on /cart_effort."""
    publishes(run, EFFORT, "std_msgs/msg/Float64", at_least=5)


@push.check(5, after=pushes)
def keeps_it_up(run: Recording) -> None:
    """The pole stays up for 19 s, although the cart is pushed twice."""
    stands(run)


@push.check(2, after=(pushes, keeps_it_up))
def spares_the_motor(run: Recording) -> None:
    """The effort never exceeds 10 N, in either direction."""
    keeps_to_limits(run, LIMIT)


@push.check(5, after=keeps_it_up)
def comes_back(run: Recording) -> None:
    """Three seconds after each push the cart is back, within 5 cm of the middle, and stays there."""
    still_stands(run)
    with hinting("A larger gain on the position brings it back sooner; increase the gain on the speed along "
                 "with it."):
        for begin, end in _after_pushes(run):
            settles(run.during(begin, end), 0.0, seconds=SOON, tolerance=NEAR)


@push.check(2, after=keeps_it_up)
def stands_quietly(run: Recording) -> None:
    """The pole then stays upright, within 0.05 rad."""
    still_stands(run)
    for begin, end in _after_pushes(run):
        rest = lean(run.during(begin + SOON, end))
        stamp, angle = max(rest, key=lambda row: abs(row[1]), default=(begin, 0.0))
        if not is_near(angle, 0.0, STEADY):
            hint = "It swings for too long: more D damps it, and so does a larger gain on the cart's speed."
            raise Missed(f"at most {STEADY:g} rad", f"{angle:.2g} rad at {stamp:.3g} s", hint)


def _after_pushes(run: Recording) -> list[tuple[float, float]]:
    """From the end of each push to the next one, or to the end of the run."""
    assert run.world is not None and run.world.machine is not None
    pushed = sorted(run.world.machine.pushes, key=lambda one: one.begin)
    begins = [one.begin + one.seconds for one in pushed]
    return list(zip(begins, [one.begin for one in pushed[1:]] + [run.ended.stamp], strict=True))
