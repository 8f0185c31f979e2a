"""Drive to a goal without a map."""

import math

from grader.checks import Missed, publishes, series, tenths, traveled
from grader.checks.motion import arrives, ends_with_a_stop, length, stands_still
from grader.companions.radios import WIFI
from grader.exercise import Exercise, Scenario
from grader.responses import Window, closest
from grader.worlds.rooms import yard_from
from sim.evidence import Recording

GOAL = (5.0, 5.0)
NEAR, STOP = 0.2, 0.1  # meters

drive = Exercise("drive", "To the goal", may_end=True, scenarios=[
    Scenario(yard_from, 60, 1),
    Scenario(yard_from, 60, 2, network=WIFI),
])


def _speeds(run: Recording) -> list[float]:
    return [value for _, value in series(run, "/cmd_vel", "linear.x")]


def _turns(run: Recording) -> bool:
    return any(value for _, value in series(run, "/cmd_vel", "angular.z"))


def _straight(run: Recording) -> float:
    """The length of the straight line from the start to the goal (m)."""
    return math.dist(GOAL, run.path[0][1:3])


@drive.check(1)
def sends_velocities(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")


@drive.check(7, after=sends_velocities, guess={
    "The robot never turned: angular.z follows the bearing, such as 2.0 * bearing.":
        lambda run: any(_speeds(run)) and not _turns(run),
    "All commands are zeros; they should be zero only when the goal is closer than 0.1 m: is it > or <?":
        lambda run: not any(_speeds(run)) and not _turns(run),
    "The robot was never commanded to drive ahead: set linear.x (m/s).": lambda run: not any(_speeds(run)),
    "It was commanded backwards: a positive linear.x drives forward.": lambda run: max(_speeds(run)) <= 0,
    "The commands stopped too early. Publish one for each /odom message, until the robot is there.":
        lambda run: run.path[-1].stamp - run.messages("/cmd_vel")[-1].stamp > 1,
    "It keeps turning. A positive bearing is to the left, and so is a positive angular.z.":
        lambda run: traveled(run) < 0.5,
    "It was commanded to stop at ({x:.2f}, {y:.2f}) m: linear.x became 0 there.":
        lambda run: _speeds(run)[-1] == 0.0 and run.path[-1]._asdict(),
    "It drives past the goal. Turn faster for the same bearing, and go slowly while the bearing is large.":
        lambda run: traveled(run) > _straight(run),
    "It drove {way:.2f} m in {time:.0f} s: 0.3 m/s or more is a good speed.":
        lambda run: {"way": traveled(run), "time": run.ended.stamp},
})
def gets_there(run: Recording) -> None:
    """The robot comes within 20 cm of (5, 5)."""
    left, stamp = closest(run.path, GOAL)
    if left > NEAR:
        come = 1 - math.dist(GOAL, run.path[-1][1:3]) / _straight(run)
        credit = tenths(0.8 * come) if come >= 0.75 else 0.0  # less may be by chance
        saw = f"{left:.2f} m away at its closest, at {stamp:.3g} s"
        raise Missed("the robot within 0.2 m of (5, 5) m", saw, credit=credit, picture="path")


@drive.check(4, after=gets_there, guess={
    "Get the robot to the goal first.": lambda run: closest(run.path, GOAL)[0] > NEAR,
    "It passes the goal {left:.2f} m to the side: turn faster for the same bearing, or drive more slowly.":
        lambda run: (left := closest(run.path, GOAL)[0]) > STOP and {"left": left},
    "Closer than 0.1 m is close enough: then publish a Twist() of zeros.": lambda run: True,
})
def stays_there(run: Recording) -> None:
    """At the end the robot stands still, within 20 cm of (5, 5)."""
    arrives(run, GOAL, tolerance=NEAR)
    stands_still(run)
    ends_with_a_stop(run)


@drive.check(2, after=gets_there)
def goes_straight(run: Recording) -> None:
    """The path to the goal is no more than 15 % longer than the straight line."""
    reached = next((pose.stamp for pose in run.path if math.dist(GOAL, pose[1:3]) <= NEAR), None)
    if reached is None:
        raise Missed("a path to (5, 5)", "the robot did not get there", "Get the robot to the goal first.",
                     picture="path")
    way, most = length(Window(0.0, reached).rows(run.path)), 1.15 * _straight(run)
    if way > most:
        hint = "Turn towards the goal first; while the bearing is large, drive slowly or not at all."
        raise Missed(f"a path of {most:.2f} m or less", f"{way:.2f} m", hint, picture="path")
