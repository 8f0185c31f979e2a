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
from grader.checks.control import NO_EFFORT, SWINGS, TOO_WEAK, WRONG_WAY
from sim import World
from sim.evidence import Pose
from tests.grader.recordings import published, recording


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


def test_a_pole_that_nobody_holds():
    miss = missed(stands, carried([0.1, 0.3, 0.6, 1.0]))
    assert (miss.expected, miss.saw) == (
        "a pole that stands for 0.4 s",
        "it fell: at 0.2 s it leant by more than 0.5 rad",
    )
    assert (miss.hint, miss.credit) == (NO_EFFORT, 0.25)
    assert missed(still_stands, carried([0.1, 0.6])).saw == "it fell at 0.1 s"


def test_a_pole_that_falls_early_earns_nothing_of_its_time():
    assert missed(stands, carried([0.1, 0.6, 1.0, 1.5])).credit == 0.0


def quick(force):
    return [(0.01 * n, force) for n in range(30)]


@pytest.mark.parametrize(
    ("angles", "xs", "efforts", "hint"),
    [
        ([0.1, 0.3, 0.6], None, quick(1.0), WRONG_WAY),
        ([0.1, 0.3, 0.6], None, quick(-1.0), TOO_WEAK),
        ([0.1, -0.3, 0.6], None, quick(-1.0), SWINGS),
        (
            [0.1, 0.3, 0.6],
            None,
            [(0.0, -1.0), (0.1, -1.0)],
            "The efforts came too seldom: up to 0.1 s passed between two of them. The pole falls while nobody "
            "looks: push at each joint state, and let nothing hold the loop up.",
        ),
        (
            [0.1, 0.1, 0.6],
            [0.0, -1.0, -1.0],
            quick(-1.0),
            "The cart rolled to the end of the track, which stopped it. Its place has to count, too.",
        ),
    ],
)
def test_why_it_fell(angles, xs, efforts, hint):
    assert missed(stands, carried(angles, xs, efforts=efforts)).hint == hint


def test_a_cart_settles_where_it_comes_near_for_good():
    run = carried([0.0] * 6, [0.0, 0.3, 0.5, 0.56, 0.5, 0.5])
    assert settles(run, 0.5, seconds=0.3, tolerance=0.05) == pytest.approx(0.3)
    assert settles(run.during(0.4), 0.5, seconds=0.3, tolerance=0.05) == 0.0


def test_a_cart_that_takes_too_long():
    run = carried([0.0] * 5, [0.0, 0.3, 0.4, 0.5, 0.5])
    miss = missed(settles, run, 0.5, seconds=0.1, tolerance=0.05)
    assert miss.expected == "the cart within 5 cm of 0.50 m, from 0.1 s after 0 s on"
    assert miss.saw == "it is further away until 0.2 s"
    miss = missed(settles, carried([0.0] * 3), 0.5, seconds=0.1, tolerance=0.05)
    assert miss.saw == "0.00 m at 0.2 s"


def test_how_far_it_goes_beyond():
    run = carried([0.0] * 4, [0.0, -0.3, -0.6, -0.5])
    assert overshoots(run, -0.5, most=0.12) == pytest.approx(0.1)
    assert overshoots(run, -0.9, most=0.12) == 0.0
    miss = missed(overshoots, run, -0.4, most=0.12)
    assert (miss.expected, miss.saw) == ("at most 12 cm beyond -0.40 m", "20 cm beyond it at 0.2 s")


def test_efforts_have_limits():
    run = published("/cart_effort", [(0.1, Float64(data=2.0)), (0.2, Float64(data=-3.5))])
    keeps_to_limits(run, 4.0)
    miss = missed(keeps_to_limits, run, 3.0)
    assert (miss.expected, miss.saw) == (
        "data on /cart_effort from -3 to 3 N",
        "-3.5 N at 0.2 s; 1 of 2 are outside",
    )
    assert miss.hint == "Cut it before you publish it: max(-3, min(3, effort))."


def ticking(*moments, seconds):
    return published("/tick", [(moment, Float64()) for moment in moments], seconds=seconds)


def test_deadlines_are_kept():
    run = ticking(0.1, 0.3, 0.4, 0.5, seconds=0.6)
    assert keeps_deadline(run, "/tick", 0.1) == pytest.approx(0.1)


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
