"""What the worlds of 08_joints and 08b_drawing hold for every seed: tasks can be done, mistakes show."""

import itertools
import math

import pytest

from grader.companions.joint_targets import CRUISE, LESSON, NAMES, paths, poses, stations
from grader.exercises.drawing.draw.figure import figure
from grader.exercises.joints.careful.lift import plan
from grader.worlds.arms import EDGE, arm_of, desk_of, joint_of, side_of

SEEDS = range(100)


def lowest_elbow(seed, left):
    """How far (m) the elbow gets to the table's side, where the figure's is positive."""
    model, side = desk_of(seed).machine, side_of(seed)
    return min(model.elbow_pose(*model.inverse(x, y, left))[1] * side for x, y in figure(seed))


@pytest.mark.parametrize("seed", [0, 1, 2, *range(3, 100, 7)])
def test_a_figure_can_be_drawn_with_one_elbow_and_with_the_other_the_arm_hits_the_table(seed):
    right = side_of(seed) < 0
    assert lowest_elbow(seed, right) > 0.1
    assert lowest_elbow(seed, not right) < -EDGE
    model = desk_of(seed).machine
    angles = [angle for x, y in figure(seed) for angle in model.inverse(x, y, right)]
    assert max(map(abs, angles)) < 2.6


def test_all_figures_but_the_first_are_in_front_of_the_shoulder_and_behind_it():
    assert all(x > 0 for x, _ in figure(1))
    for seed in SEEDS[2:]:
        assert min(x for x, _ in figure(seed)) < -0.05 and max(x for x, _ in figure(seed)) > 0.3


def test_both_sides_lengths_and_orders_occur():
    assert {side_of(seed) for seed in SEEDS} == {1, -1} == {side_of(1), side_of(2)}
    assert {desk_of(seed).machine.elbow_first for seed in SEEDS} == {True, False}
    assert len({desk_of(seed).machine.shoulder.length for seed in SEEDS}) > 10


def test_a_joint_gets_everywhere_in_time_and_two_seconds_are_not_always_enough():
    for seed in SEEDS:
        model, places = joint_of(seed).machine, stations(seed)
        times = [abs(b - a) / model.max_velocity for a, b in itertools.pairwise([0.0, *places])]
        assert all(model.lower <= place <= model.upper for place in places)
        assert max(times) > 2.4 and sum(times) + 4 * 0.5 < 18


def test_each_joint_gets_near_each_of_its_limits_once():
    for seed in SEEDS:
        near = []
        for pose in poses(seed):
            for name, joint, place in zip(NAMES, arm_of(seed).machine.joints, pose, strict=True):
                near += [(name, "lower")] if place - joint.lower < 0.101 else []
                near += [(name, "upper")] if joint.upper - place < 0.101 else []
        assert sorted(near) == [(name, end) for name in sorted(NAMES) for end in ("lower", "upper")]


def test_a_joint_rests_at_a_limit_and_another_after_a_short_way_where_the_margin_ends():
    for seed in SEEDS:
        joints, rows, margins = arm_of(seed).machine.joints, poses(seed), []
        for before, row in itertools.pairwise(rows):
            for joint, start, place in zip(joints, before, row, strict=True):
                margin = min(place - joint.lower, joint.upper - place)
                margins.append(round(margin, 9))
                assert margins[-1] != 0.1 or abs(place - start) < 0.6
        assert margins.count(0.0) == margins.count(0.1) == 1


def test_one_path_of_three_goes_beyond_a_limit_and_the_others_take_less_than_a_lesson():
    for seed in SEEDS:
        joints = dict(zip(NAMES, arm_of(seed).machine.joints, strict=True))
        for path in paths(seed):
            inside = [
                joints[name].lower <= place <= joints[name].upper
                for point in path.points
                for name, place in zip(path.names, point, strict=True)
            ]
            assert all(inside) == (path.kind != "beyond")
            ways = [max(map(abs, map(float.__sub__, b, a))) for a, b in itertools.pairwise(path.points)]
            assert path.kind == "beyond" or sum(ways) / CRUISE < LESSON / 2
        kinds = [path.kind for path in paths(seed)]
        assert sorted(kinds) == ["beyond", "good", "interrupted"]
        assert kinds[-1] != "good", "after it the arm isn't where it was at the beginning"


def test_a_lift_is_wanted_at_good_and_bad_places_and_gets_stuck_between_good_ones():
    for seed in SEEDS:
        made = plan(seed)
        good = [position for position in made.requests if made.lower <= position <= made.upper]
        bad = [position for position in made.requests if not made.lower <= position <= made.upper]
        assert (len(good), len(bad), sum(map(math.isnan, bad))) == (5, 3, 1)
        assert made.requests[0] == good[0] in (made.lower, made.upper)
        assert {min(good), max(good)} == {made.lower, made.upper}, "the limits themselves"
        assert len(made.jams) == 2 and all(min(good) < jam < max(good) for jam in made.jams)
