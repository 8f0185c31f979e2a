"""What the measures of joints see in recordings written by hand."""

import math
from dataclasses import replace

import pytest
from std_msgs.msg import Float64, String

from grader import Missed
from grader.checks import commands_within, draws, keeps_off, tip_at, tip_path
from grader.checks.joints import JointLimits, described_limits
from sim import World
from sim.evidence import Pose
from tests.sim.recordings import exchange, published, recording

LINE = [(0.5, 0.3), (0.7, 0.3)]


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def reaching(places, walls=()):
    """A run in which the tip of the arm is at places, one a second; its elbow bends to the right."""
    world = replace(World.load("arm"), walls=walls)
    tracks = {"upper_arm": [], "forearm": []}
    for second, place in enumerate(places):
        shoulder, elbow = world.machine.inverse(*place)
        tracks["upper_arm"].append(Pose(float(second), 0.0, 0.0, shoulder))
        tracks["forearm"].append(Pose(float(second), *world.machine.elbow_pose(shoulder, elbow)))
    return recording(world=world, tracks=tracks)


def test_the_tip_is_where_it_was_sent():
    run = reaching(LINE)
    assert [pose[1:3] for pose in tip_path(run)] == [pytest.approx(place) for place in LINE]
    assert tip_at(run, 0.9).stamp == 0.0
    assert tip_at(run, 1.0)[1:3] == pytest.approx(LINE[1])
    assert tip_at(run, 1.0 - 5e-7).stamp == 1.0  # but for rounding
    assert tip_at(run, 0.9995).stamp == 0.0
    assert tip_at(run, -1.0).stamp == 0.0


def test_the_tip_of_a_single_joint_points_as_the_joint_does():
    run = recording(world=World.load("joint"), tracks={"link": [Pose(0.0, 0.0, 0.0, 0.5)]})
    assert tip_at(run, 1.0) == pytest.approx((0.0, 0.5 * math.cos(0.5), 0.5 * math.sin(0.5), 0.5))


@pytest.mark.parametrize("world", [None, "yard", "cart_pole"])
def test_a_run_without_an_arm_is_the_authors_mistake(world):
    run = recording(world=world and World.load(world))
    with pytest.raises(
        ValueError, match="this run has no arm: give the exercise a world with a machine made of"
    ):
        tip_path(run)


def test_the_margin_of_a_position_is_that_to_the_nearer_limit():
    limits = JointLimits(-0.5, 2.0)
    assert [limits.margin(position) for position in (-1.0, -0.5, 0.25, 1.5, 3.0)] == [-0.5, 0.0, 0.75, 0.5, -1.0]


def robot(lower):
    limit = f'<limit lower="{lower}" upper="1.5"/>'
    return String(data=f'<robot><joint name="lift">{limit}</joint><joint name="wheel"/></robot>')


def test_limits_are_those_that_the_course_describes():
    streams = [("/robot_description", [(1.0, robot(-9.0))], False), ("/robot_description", [(2.0, robot(-0.5))], True)]
    assert described_limits(exchange(*streams)) == {"lift": (-0.5, 1.5)}


def test_a_command_at_a_limit_is_within_it():
    run = published("/joint_commands", [(1.0, Float64(data=-1.0)), (2.0, Float64(data=1.0))])
    commands_within(run, "/joint_commands", "data", -1.0, 1.0)


def test_a_command_beyond_the_limits_is_unsafe():
    sent = [(1.0, Float64(data=0.5)), (2.0, Float64(data=-1.5)), (3.0, Float64(data=math.nan))]
    run = published("/joint_commands", sent)
    commands_within(run.during(0.0, 1.5), "/joint_commands", "data", -1.0, 1.0)
    miss = missed(commands_within, run, "/joint_commands", "data", -1.0, 1.0, "Refuse it.")
    assert (miss.expected, miss.saw) == ("commands from -1 to 1 rad on /joint_commands", "-1.5 at 2 s")
    assert (miss.hint, miss.unsafe, miss.picture) == ("Refuse it.", True, "topics")
    assert missed(commands_within, run, "/joint_commands", "data", -2.0, 1.0).saw == "nan at 3 s"


def test_an_arm_in_a_wall_is_unsafe():
    table = (((-1.0, -0.05), (1.0, -0.05)),)
    keeps_off(reaching(LINE))
    miss = missed(keeps_off, reaching([(0.9, 0.0), *LINE], table), "Bend the elbow the other way.")
    assert miss.expected == "an arm that touches nothing"
    assert miss.saw == "its upper_arm in the wall at 1 s, between (0.00, 0.00) and (0.49, -0.10) m"
    assert (miss.hint, miss.unsafe, miss.picture) == ("Bend the elbow the other way.", True, "path")


@pytest.mark.parametrize(
    ("wall", "link"),
    [
        (((0.5, 0.1), (0.7, 0.1)), "forearm"),
        (((0.7, 0.1), (0.5, 0.1)), "forearm"),
        (((0.6, 0.0), (0.6, 0.4)), "forearm"),
        (((0.2, -0.5), (0.3, 0.5)), "upper_arm"),
        (((0.65, 0.1), (0.8, 0.1)), ""),  # beside the forearm
        (((0.3, 0.1), (0.5, 0.1)), ""),
        (((0.7, 0.5), (0.9, 0.4)), ""),  # beyond the tip
        (((-0.2, -0.5), (-0.1, 0.5)), ""),  # behind the shoulder
        (((0.2, -0.5), (0.25, -0.1)), ""),  # ends before the upper arm
        (((0.0, 0.0), (0.0, -1.0)), ""),  # on which the shoulder is
        (((0.0, 0.0), (-1.0, 1.0)), ""),
    ],
)
def test_a_link_is_in_a_wall_where_the_two_cross(wall, link):
    run = reaching([LINE[1]], (wall,))
    if link:
        ends = {"upper_arm": "(0.00, 0.00) and (0.50, -0.05)", "forearm": "(0.50, -0.05) and (0.70, 0.30)"}[link]
        assert missed(keeps_off, run).saw == f"its {link} in the wall at 0 s, between {ends} m"
    else:
        keeps_off(run)


@pytest.mark.parametrize("wall", [((0.25, 0.0), (0.25, 1.0)), ((0.5, -1.0), (0.5, 1.0)), ((0.5, 1.0), (0.5, 0.0))])
def test_a_link_that_touches_a_wall_without_crossing_it_is_no_miss(wall):
    world = replace(World.load("joint"), walls=(wall,))
    run = recording(world=world, tracks={"link": [Pose(0.0, 0.0, 0.0, 0.0)]})
    assert tip_at(run, 0.0)[1:3] == (0.5, 0.0)
    keeps_off(run)


def test_a_figure_is_drawn_to_its_end():
    run = reaching([(0.9, 0.0), *LINE])
    assert draws(run, LINE) == pytest.approx(0.0, abs=1e-6)
    miss = missed(draws, reaching([(0.9, 0.0), (0.5, 0.3), (0.65, 0.3)]), LINE, hint="Go on.")
    assert miss.expected == "all of the figure within 2 cm of the tip's path"
    assert miss.saw == "86% of it; the tip never came closer than 0.05 m to (0.70, 0.30) m"
    assert (miss.hint, miss.picture) == ("Go on.", "path")
    assert miss.credit == pytest.approx(18 / 21)
    assert missed(draws, reaching([(0.9, 0.0), (0.5, 0.3), (0.55, 0.3)]), LINE).credit == 0.0


@pytest.mark.parametrize(("end", "credit"), [(0.585, 11 / 21), (0.575, 0.0)])
def test_a_figure_that_is_drawn_for_more_than_half_earns_that_part(end, credit):
    miss = missed(draws, reaching([(0.9, 0.0), (0.5, 0.3), (end, 0.3)]), LINE)
    assert miss.credit == pytest.approx(credit)


def test_a_tip_may_be_anywhere_until_it_comes_to_the_first_point():
    assert draws(reaching([LINE[1], (0.9, 0.0), *LINE]), LINE) == pytest.approx(0.0, abs=1e-6)


def test_a_tip_may_be_as_far_from_the_figure_as_is_said():
    run = reaching([(0.9, 0.0), *LINE, (0.7, 0.339)])
    assert draws(run, LINE, tolerance=0.04) == pytest.approx(0.039)
    assert missed(draws, run, LINE, tolerance=0.038).saw.startswith("0.04 m away at 3 s")


def test_a_tip_that_leaves_the_figure_is_seen():
    miss = missed(draws, reaching([(0.9, 0.0), *LINE, (0.7, 0.4)]), LINE)
    assert miss.expected == "a tip that stays within 2 cm of the figure once it has begun"
    assert (miss.saw, miss.credit) == ("0.10 m away at 3 s, at (0.70, 0.40) m", 0.5)
    assert miss.picture == "path"
    back = missed(draws, reaching([(0.9, 0.0), *LINE, (0.7, 0.4), LINE[1]]), LINE)
    assert back.saw == miss.saw
