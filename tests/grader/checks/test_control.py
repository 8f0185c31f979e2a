import math

import pytest
from std_msgs.msg import Float64

from grader import Missed
from grader.checks import (
    fell_at,
    keeps_deadline,
    keeps_to_limits,
    lean,
    overshoots,
    places,
    settles,
    stands,
    still_stands,
)
from sim import World
from sim.evidence import Pose
from tests.sim.recordings import published, recording

NO_EFFORT = "Nothing pushed the cart: publish an effort on /cart_effort each time a joint state arrives."
WRONG_WAY = "The cart is pushed the wrong way from the start. A positive angle means that the pole leans to the left: the cart has to get under it, to the left, which takes a negative effort."
TOO_WEAK = "The pole fell to the side it leaned to from the start: the cart didn't get under it. Is the gain on the angle large enough, and does the one on the rate have the same sign?"
SWINGS = "It swung more and more widely, as it does with P alone. Add D, a gain on the pole's rate, with the same sign. If you have it already, make it larger."
TRACK = "The cart rolled to the end of the track, which stopped it. The effort has to depend on its position, too."


def carried(angles, xs=None, *, efforts=(), seconds=None):
    """A run with the pole at these angles, one every 0.1 s, and the cart at these places."""
    xs = [0.0] * len(angles) if xs is None else xs
    upright = math.pi / 2
    tracks = {
        "pole": [Pose(n / 10, x, 0.0, upright + a) for n, (x, a) in enumerate(zip(xs, angles, strict=True))],
        "cart": [Pose(n / 10, x, 0.0, 0.0) for n, x in enumerate(xs)],
    }
    sent = published("/cart_effort", [(t, Float64(data=force)) for t, force in efforts]) if efforts else None
    return recording(
        seconds=len(angles) / 10 if seconds is None else seconds,
        tracks=tracks,
        world=World.load("cart_pole"),
        published=sent.published if sent else [],
    )


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def test_the_pole_and_the_cart_are_seen_as_they_truly_are():
    run = carried([0.1, -0.2], [0.0, 0.3])
    assert lean(run) == [(0.0, pytest.approx(0.1)), (0.1, pytest.approx(-0.2))]
    assert places(run) == [(0.0, 0.0), (0.1, 0.3)]


def test_a_pole_that_stands_is_content():
    run = carried([0.1, -0.2, 0.49])
    stands(run)
    still_stands(run)
    assert fell_at(run) is None


def test_a_run_without_a_pole_is_our_mistake():
    with pytest.raises(ValueError, match="this run has no pole: give the exercise a world that has one"):
        stands(recording())


def test_a_pole_that_no_one_holds():
    miss = missed(stands, carried([0.1, 0.3, 0.6, 1.0]))
    assert (miss.expected, miss.saw) == (
        "a pole that stands for 0.4 s",
        "it fell: at 0.2 s it leaned by more than 0.5 rad",
    )
    assert (miss.hint, miss.credit) == (NO_EFFORT, 0.25)
    miss = missed(still_stands, carried([0.1, 0.6]))
    assert (miss.expected, miss.saw) == ("a pole that stands meanwhile", "it fell at 0.1 s")
    assert miss.hint == "Keep the pole up first."


def test_a_pole_that_falls_early_earns_nothing_of_its_time():
    assert missed(stands, carried([0.1, 0.6, 1.0, 1.5])).credit == 0.0
    assert missed(stands, carried([0.1] * 9 + [0.6], seconds=2.0)).credit == 0.0
    assert missed(stands, carried([0.1] * 11 + [0.6], seconds=2.0)).credit == pytest.approx(0.275)


@pytest.mark.parametrize("side", [1, -1])
def test_a_pole_has_fallen_that_leans_by_more_than_half_a_radian_to_either_side(side):
    assert fell_at(carried([0.1, side * 0.49])) is None
    assert fell_at(carried([0.1, side * 0.51])) == 0.1


def quick(force, period=0.01):
    return [(period * n, force) for n in range(round(0.3 / period))]


def seldom(seconds):
    return f"The efforts were too rare: up to {seconds} s passed between two of them, and the pole falls in the meantime. Publish one for each joint state, and let nothing block the loop."


def refused(push):
    return f"An effort was {push}, which the cart refuses: check how it is calculated. Did it divide by 0?"


def ends(last):
    return f"After {last} s no effort came any more, and the cart kept to that one. Publish one for each joint state, from start to end."


END = World.load("cart_pole").machine.track_length / 2


@pytest.mark.parametrize(
    ("angles", "xs", "efforts", "hint"),
    [
        ([0.1, 0.3, 0.6], None, quick(1.0), WRONG_WAY),
        ([0.1, 0.3, 0.6], None, quick(-1.0), TOO_WEAK),
        ([0.1, -0.3, 0.6], None, quick(-1.0), SWINGS),
        ([0.1, 0.3, 0.6], None, [(0.0, -1.0), (0.1, -1.0)], seldom("0.1")),
        ([0.1, 0.3, 0.6], None, [(0.0, -1.0), (0.01, -1.0), (0.057, -1.0)], seldom("0.047")),
        ([0.1, 0.3, 0.6], None, quick(-1.0, 0.043), TOO_WEAK),
        ([0.1, 0.3, 0.6], None, [(0.1, -1.0)], TOO_WEAK),
        ([0.1, 0.3, 0.6], None, [(0.2, -1.0), (0.3, -1.0)], NO_EFFORT),
        ([0.1, 0.3, 0.6], None, quick(0.0), TOO_WEAK),
        ([0.1, 0.3, 0.6], None, quick(math.nan), refused("nan")),
        ([0.1, 0.3, 0.6], None, [*quick(1.0), (0.15, -math.inf)], refused("-inf")),
        ([0.1] * 4 + [0.6], None, [(0.0, -1.0), (0.04, -1.0)], ends("0.04")),
        ([0.1, 0.3, 0.6], None, [(0.0, 0.0), *quick(1.0)], WRONG_WAY),
        ([-0.1, 0.3, 0.6], None, quick(1.0), SWINGS),
        ([0.0, 0.3, 0.6], None, quick(1.0), TOO_WEAK),
        ([0.018, -0.3, -0.6], None, quick(-1.0), TOO_WEAK),
        ([0.022, -0.3, -0.6], None, quick(-1.0), SWINGS),
        ([0.1, 0.3, 0.6, -0.1], None, quick(-1.0), TOO_WEAK),
        ([0.1, 0.3, -0.6], None, quick(-1.0), TOO_WEAK),
        ([0.1, 0.1, 0.6], [0.0, -1.0, -1.0], quick(-1.0), TRACK),
        ([0.1, 0.1, 0.6], [0.0, 0.0, END - 0.009], quick(-1.0), TRACK),
        ([0.1, 0.1, 0.6, 1.0], [0.0, 0.0, END - 0.011, END], quick(-1.0), TOO_WEAK),
    ],
)
def test_why_it_fell(angles, xs, efforts, hint):
    assert missed(stands, carried(angles, xs, efforts=efforts)).hint == hint


def test_a_cart_settles_where_it_comes_near_for_good():
    run = carried([0.0] * 6, [0.0, 0.3, 0.5, 0.56, 0.5, 0.5])
    assert settles(run, 0.5, seconds=0.3, tolerance=0.05) == pytest.approx(0.3)
    assert settles(run.during(0.2), 0.5, seconds=0.3, tolerance=0.05) == pytest.approx(0.1)
    assert settles(run.during(0.4), 0.5, seconds=0.3, tolerance=0.05) == 0.0


def test_a_cart_may_take_as_long_as_is_said_and_be_as_far_away():
    run = carried([0.0] * 3, [0.0, 0.25, 0.5])
    assert settles(run, 0.25, seconds=0.2, tolerance=0.25) == 0.0
    assert settles(run, 0.25, seconds=0.2, tolerance=0.2) == 0.2


def test_a_cart_that_takes_too_long():
    run = carried([0.0] * 5, [0.0, 0.3, 0.4, 0.5, 0.5])
    miss = missed(settles, run, 0.5, seconds=0.1, tolerance=0.05)
    assert miss.expected == "the cart within 5 cm of 0.50 m, from 0.1 s after 0 s on"
    assert miss.saw == "it is farther away until 0.2 s"
    miss = missed(settles, carried([0.0] * 3), 0.5, seconds=0.1, tolerance=0.05)
    assert miss.saw == "0.00 m at 0.2 s"


def test_how_far_it_goes_beyond():
    run = carried([0.0] * 4, [0.0, -0.3, -0.6, -0.5])
    assert overshoots(run, -0.5, most=0.12) == pytest.approx(0.1)
    assert overshoots(run, -0.9, most=0.12) == 0.0
    miss = missed(overshoots, run, -0.2, most=0.12)
    assert (miss.expected, miss.saw) == ("at most 12 cm beyond -0.20 m", "40 cm beyond it at 0.2 s")


def test_beyond_is_seen_from_where_the_cart_was_at_first():
    run = carried([0.0] * 4, [1.25, 0.0, 0.5, 0.25])
    assert overshoots(run, 0.25, most=0.25) == 0.25
    miss = missed(overshoots, carried([0.0] * 3, [0.25, 1.75, 0.75]), 0.75, most=0.5)
    assert miss.saw == "100 cm beyond it at 0.1 s"


def test_efforts_have_limits():
    run = published("/cart_effort", [(0.1, Float64(data=2.0)), (0.2, Float64(data=-3.5))])
    keeps_to_limits(run, 4.0)
    miss = missed(keeps_to_limits, run, 3.0)
    assert (miss.expected, miss.saw) == (
        "data on /cart_effort from -3 to 3 N",
        "-3.5 N at 0.2 s; 1 of 2 are outside",
    )
    assert miss.hint == "Clip it before you publish it: max(-3, min(3, effort))."


def test_an_effort_that_goes_elsewhere_has_a_hint_of_its_own():
    run = published("/cart_efort", [(0.1, Float64(data=2.0))])
    assert missed(keeps_to_limits, run, 3.0).hint == "Is /cart_efort a typo? Did you mean /cart_effort?"


def ticking(*moments, seconds):
    return published("/tick", [(moment, Float64()) for moment in moments], seconds=seconds)


def test_deadlines_are_kept():
    run = ticking(0.1, 0.3, 0.35, 0.5, seconds=0.6)
    assert keeps_deadline(run, "/tick", 0.15) == pytest.approx(0.15)


def test_a_deadline_is_missed_by_half_a_millisecond_and_not_by_rounding():
    assert keeps_deadline(ticking(0.2, 0.3, 0.4, seconds=0.4), "/tick", 0.1) > 0.1
    miss = missed(keeps_deadline, ticking(0.2, 0.3005, 0.4, seconds=0.4), "/tick", 0.1)
    assert (miss.saw, miss.picture) == ("1 deadline missed, the worst by 0.0005 s, after 0.2 s", "topics")


def test_deadlines_count_from_a_fifth_of_a_second_on():
    assert keeps_deadline(ticking(0.18, 0.3, 0.39, seconds=0.4), "/tick", 0.1) == pytest.approx(0.1)
    assert missed(keeps_deadline, ticking(0.32, 0.4, seconds=0.4), "/tick", 0.1).saw.endswith("after 0.2 s")
    assert keeps_deadline(ticking(0.32, 0.4, seconds=0.4), "/tick", 0.1, begin=0.25) == pytest.approx(0.08)


def test_missed_deadlines_are_counted_to_the_end():
    run = ticking(0.3, 0.5, 0.6, seconds=1.0)
    miss = missed(keeps_deadline, run, "/tick", 0.15, hint="Hurry.")
    assert (miss.expected, miss.saw, miss.hint) == (
        "a message on /tick at least every 0.15 s",
        "2 deadlines missed, the worst by 0.25 s, after 0.6 s",
        "Hurry.",
    )
    miss = missed(keeps_deadline, ticking(0.3, 0.5, seconds=0.6), "/tick", 0.15)
    assert miss.saw == "1 deadline missed, the worst by 0.05 s, after 0.3 s"
