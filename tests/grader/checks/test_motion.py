import math

import numpy as np
import pytest
from geometry_msgs.msg import Twist

from grader import Missed
from grader.checks import arrives, ends_with_a_stop, follows, keeps_clear, passes, stands_still, traveled
from grader.checks.motion import (
    after_a_touch,
    distances_to_line,
    has_no_contacts,
    is_hopeless,
    stood_still,
    until_a_touch,
    yaw_at,
)
from sim import run
from sim.evidence import Pose
from tests.sim.recordings import driven, published, recording
from tests.students import flaws

LATER = (3.0, 4.0, 3.0, 1.0, "left", "box")
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    assert caught.value.picture == "path"
    return caught.value


def test_keeps_clear_is_content_without_contacts():
    keeps_clear(driven(SQUARE))


def test_keeps_clear_tells_the_first_contact():
    touch = (3.25, 4.0, 1.0, 2.0, "front", "wall")
    miss = missed(keeps_clear, driven(SQUARE, contacts=[touch]))
    assert miss.expected == "no contact with walls or boxes"
    assert miss.saw == "1 contact; the first at 3.25 s: a wall at (1.00, 2.00) m, on the robot's front side"
    assert miss.hint == "Slow down or turn away earlier: /scan gives the distance to the nearest wall."
    assert miss.unsafe
    assert missed(keeps_clear, driven(SQUARE, contacts=[touch]), "Look ahead.").hint == "Look ahead."
    twice = driven(SQUARE, contacts=[touch, (3.75, 4.0, 0.0, 2.0, "left", "box")])
    assert missed(keeps_clear, twice).saw.startswith("2 contacts; the first at 3.25 s: a wall")


def test_until_a_touch_is_the_run_before_the_first_one():
    touched = driven(SQUARE, contacts=[(1.5, 2.0, 1.0, 2.0, "front", "wall"), (3.5, 4.0, 1.0, 2.0, "front", "wall")])
    assert [pose.stamp for pose in until_a_touch(touched).path] == [0.0, 1.0]
    whole = driven(SQUARE)
    assert until_a_touch(whole) is whole


def test_arrives_measures_the_distance_to_the_goal():
    assert arrives(driven([(0, 0), (1.0, 0.05)]), (1.0, 0.0)) == pytest.approx(0.05)


def test_arrives_takes_the_worlds_goal():
    miss = missed(arrives, driven([(0, 0), (1.0, 0.0)], world="room"))
    assert miss.expected == "the robot within 0.1 m of (2.3, 2.3) m at the end"
    assert miss.saw == "(1.00, 0.00) m, which is 2.64 m away"
    assert miss.hint == ""


def test_arrives_names_the_goal_that_it_was_given_and_allows_its_tolerance():
    end = driven([(0, 0), (1.25, 0.0)])
    assert arrives(end, (1.0, 0.0), tolerance=0.25) == 0.25
    assert missed(arrives, end, (1.0, 0.5)).expected == "the robot within 0.1 m of (1, 0.5) m at the end"


@pytest.mark.parametrize(("distance", "moved"), [(0.009, False), (0.01, False), (0.011, True)])
def test_a_robot_that_moves_less_than_a_centimeter_did_not_move(distance, moved):
    hint = missed(arrives, driven([(0, 0), (distance, 0)]), (1.0, 0.0)).hint
    assert (hint == "") == moved


def test_arrives_says_when_nothing_was_commanded():
    miss = missed(arrives, driven([(0, 0), (0, 0)]), (1.0, 0.0))
    assert miss.hint == "The robot did not move: nothing was published on /cmd_vel."


def test_arrives_says_when_commands_were_empty():
    commands = published("/cmd_vel", [(1.0, Twist())]).published
    miss = missed(arrives, driven([(0, 0), (0, 0)], published=commands), (1.0, 0.0))
    assert miss.hint == "The robot did not move: are linear.x (m/s) and angular.z (rad/s) of the Twist set?"


def test_arrives_needs_a_goal():
    with pytest.raises(ValueError, match=r"^there is no goal: give one, or use a world that has one$"):
        arrives(driven(SQUARE))


def test_passes_wants_the_points_in_order():
    passes(driven(SQUARE), SQUARE)
    miss = missed(passes, driven(SQUARE), [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
    assert miss.expected == "the robot within 0.1 m of 3 points, one after the other"
    assert miss.saw == "2 of them; it never reached (1, 1) m after that"
    assert miss.credit == pytest.approx(2 / 3)
    miss = missed(passes, driven(SQUARE), [(5.0, 0.0), (1.0, 0.0)])
    assert miss.saw == "none of them; it never reached (5, 0) m"
    passes(driven([(0, 0), (1.25, 0)]), [(1.0, 0.0)], tolerance=0.25)


def test_follows_measures_the_largest_distance_to_the_line():
    assert follows(driven([(0, 0), (0.5, 0.05), (1, 0)]), [(0, 0), (1, 0)]) == pytest.approx(0.05)
    miss = missed(follows, driven([(0, 0), (0.5, 0.3), (1, 0)]), [(0, 0), (1, 0)])
    assert miss.expected == "a path within 0.1 m of the line"
    assert miss.saw == "0.30 m away from it at 1 s, at (0.50, 0.30) m"
    assert follows(driven([(0, 0), (0.5, 0.25), (1, 0)]), [(0, 0), (1, 0)], tolerance=0.25) == 0.25


def test_distances_are_to_segments_and_not_to_endless_lines():
    points = np.array([(0.5, 0.5), (2.0, 0.0), (-3.0, 4.0), (0.0, 0.0)])
    assert distances_to_line(points, [(0, 0), (1, 0), (1, 0)]) == pytest.approx([0.5, 1.0, 5.0, 0.0])


def test_the_nearest_of_several_segments_of_different_lengths_counts():
    line = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (0.0, 3.0)]
    points = np.array([(3.0, -0.5), (3.5, 0.5), (4.5, 0.75), (-1.0, 3.0), (0.0, 0.75), (2.0, 1.0)])
    expected = [0.5, 0.5, 0.5, 1.0, 0.75, math.sqrt(0.8)]
    assert distances_to_line(points, line) == pytest.approx(expected)


def test_a_very_short_segment_is_a_point():
    point = np.array([(1.0, 0.0)])
    assert distances_to_line(point, [(0, 0), (1e-5, 0)]) == pytest.approx([1.0 - 1e-5], abs=1e-9)


def test_traveled_is_the_length_of_the_path():
    assert traveled(driven(SQUARE)) == pytest.approx(4.0)
    assert traveled(driven([(0, 0), (3, 4)])) == pytest.approx(math.hypot(3, 4))


def test_stands_still_looks_at_the_last_moments_only():
    stands_still(driven([(0, 0), (1, 0), (1, 0)]))
    miss = missed(stands_still, driven([(0, 0), (1, 0), (1.5, 0)]), last=1.0)
    assert miss.expected == "the robot standing still for the last 1 s"
    assert miss.saw == "it moved 0.500 m in that time"
    assert miss.hint == "Publish a Twist() with all zeros when the robot has arrived."


def ending(*poses):
    """A run that ends with these poses, given as seconds before the end, x and yaw, and began elsewhere."""
    path = [Pose(0.0, 9.0, 0.0, 0.0), *(Pose(10.0 - before, x, 0.0, yaw) for before, x, yaw in poses)]
    return recording(path=path)


def test_stands_still_allows_half_a_second_and_half_a_centimeter():
    stands_still(ending((0.51, 1.0, 0.0), (0.49, 0.0045, 0.0), (0.0, 0.0, 0.0)))
    assert missed(stands_still, ending((0.49, 0.0055, 0.0), (0.0, 0.0, 0.0))).saw == "it moved 0.005 m in that time"
    assert missed(stands_still, ending((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), last=11.0).expected == (
        "the robot standing still for the last 11 s"
    )


def test_stands_still_allows_the_tolerance_itself():
    stands_still(ending((0.4, 0.5, 0.5), (0.0, 0.0, 0.0)), tolerance=0.5)
    miss = missed(stands_still, ending((0.4, 0.5, 0.75), (0.0, 0.0, 0.0)), tolerance=0.5)
    assert miss.saw == "it turned by 0.750 rad"


@pytest.mark.parametrize("side", [1, -1])
def test_stands_still_looks_at_the_angle_too(side):
    full = math.tau * side
    stands_still(ending((0.4, 0.0, side * 3.0), (0.2, 0.0, side * 3.004 - full), (0.0, 0.0, side * 3.0)))
    miss = missed(stands_still, ending((0.4, 0.0, side * 3.006), (0.0, 0.0, side * 3.0)))
    assert miss.saw == "it turned by 0.006 rad"


def test_a_robot_that_is_stopped_was_commanded_to():
    ends_with_a_stop(run(flaws.Driver, world="yard", seconds=5, quiet=True))
    with pytest.raises(Missed) as caught:
        ends_with_a_stop(run(flaws.FallsSilent, world="yard", seconds=5, quiet=True))
    miss = caught.value
    assert (miss.expected, miss.credit) == ("zeros as the last command", 0.0)
    with pytest.raises(Missed) as caught:
        ends_with_a_stop(run(flaws.FallsSilent, world="yard", seconds=5, quiet=True), credit=0.5)
    assert caught.value.credit == 0.5
    assert miss.saw == "the last command on /cmd_vel, at 1.9 s, was 0.2 m/s and 0 rad/s"
    assert miss.hint == (
        "This robot stops by itself when no commands arrive; other robots drive on. Publish a Twist() with all zeros at the "
        "end."
    )


@pytest.mark.parametrize("measure", [keeps_clear, stands_still, lambda run: follows(run, SQUARE), lambda run: passes(run, [])])
def test_a_run_without_a_robot_is_the_authors_mistake(measure):
    with pytest.raises(ValueError, match=r"^this run has no robot: give the exercise a world$"):
        measure(recording())


def test_has_no_contacts_says_where_the_first_one_was():
    has_no_contacts(driven(SQUARE))
    touched = driven(SQUARE, contacts=[(1.5, 2.0, 1.0, 2.0, "front", "wall"), LATER])
    miss = missed(has_no_contacts, touched, "Look ahead.")
    assert miss.expected == "no contact with walls or boxes"
    assert miss.saw == "a wall touched at 1.5 s, at (1.00, 2.00) m"
    assert miss.hint == "Look ahead." and miss.unsafe
    assert after_a_touch(touched) == "It drove into a wall at 1.5 s, and its odometry has been wrong since."
    assert after_a_touch(driven(SQUARE)) == ""


def test_a_robot_stood_still_if_it_did_not_move_for_so_long():
    rests = driven([(0.0, 0.0), *[(1.0, 0.0)] * 30])
    assert stood_still(rests, 20.0)
    assert not stood_still(rests, 30.0)
    assert not stood_still(driven([(0.0, 0.0)] * 5), 20.0)
    assert stood_still(driven([(1.0, 0.0)] * 21), 20.0)


def test_a_robot_that_moved_in_the_last_second_or_long_ago_for_a_moment_did_not_stand_still():
    assert not stood_still(driven([*[(1.0, 0.0)] * 30, (1.1, 0.0)]), 20.0)
    assert not stood_still(driven([*[(1.0, 0.0)] * 10, *[(1.1, 0.0)] * 19]), 20.0)
    assert stood_still(driven([*[(1.0, 0.0)] * 10, *[(1.1, 0.0)] * 22]), 20.0)


@pytest.mark.parametrize(("distance", "stood"), [(0.0009, True), (0.0011, False)])
def test_a_robot_that_creeps_by_less_than_a_millimeter_stood_still(distance, stood):
    assert stood_still(driven([*[(distance, 0.0)] * 30, (0.0, 0.0)]), 20.0) == stood


@pytest.mark.parametrize("period", [2, 3, 5, 8, 10, 20])
def test_a_robot_that_drives_in_a_circle_did_not_stand_still(period):
    turns = [second * math.tau / period for second in range(60)]
    assert not stood_still(driven([(math.cos(turn), math.sin(turn)) for turn in turns]), 20.0)


def test_a_run_is_hopeless_some_time_after_a_touch_or_where_nothing_moves():
    touched = driven(SQUARE, contacts=[(1.5, 2.0, 1.0, 2.0, "front", "wall"), LATER])
    assert is_hopeless(touched, patience=2.0)
    assert not is_hopeless(touched, patience=2.5)
    assert is_hopeless(driven([(0.0, 0.0)] * 21), patience=2.0)
    assert not is_hopeless(driven([(0.0, 0.0)] * 20), patience=2.0)
    assert is_hopeless(driven([(1.0, 0.0), *[(0.0, 0.0)] * 22]), patience=2.0)


def test_the_true_yaw_is_that_of_the_last_pose_until_then():
    turns = recording(path=[Pose(0.0, 0.0, 0.0, 0.0), Pose(1.0, 0.0, 0.0, math.pi / 2)])
    assert [yaw_at(turns, stamp) for stamp in (-1.0, 0.5, 0.9995, 1.0)] == [0.0, 0.0, 0.0, 90.0]


def test_the_true_yaw_at_a_stamp_is_that_of_its_pose_although_sums_of_tenths_are_not_exact():
    turns = recording(path=[Pose(0.0, 0.0, 0.0, 0.0), Pose(0.1 + 0.2, 0.0, 0.0, math.pi / 2)])
    assert yaw_at(turns, 0.3) == 90.0
