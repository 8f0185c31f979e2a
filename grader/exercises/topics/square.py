"""A square, driven by the clock."""

import itertools
import math

from grader.checks import Missed, follows, publishes, series
from grader.checks.motion import arrives, ends_with_a_stop, passes, stands_still, traveled
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import closest
from sim.evidence import Recording, stamps

square = Exercise("square", "A square", world="yard", seconds=60, may_end=True, extra_allowed=True)
START, CORNERS = (0.0, 0.0), [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
NEAR = 0.15  # meters
TIMEOUT = 0.5  # seconds after which the robot stops without a command


@square.check(2)
def sends_velocities(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")


@square.check(8, after=sends_velocities, guess={
    "angular.z was {fastest:.3g}: its unit is rad/s, and a quarter turn is pi/2 = 1.57 rad.":
        lambda run: not is_near(fastest := max(abs(turn) for _, turn in series(run, "/cmd_vel", "angular.z")),
                                0.0, math.tau) and {"fastest": fastest},
    "This robot can't move sideways, so it ignores linear.y: turn, then drive ahead with linear.x.":
        lambda run: any(value for _, value in series(run, "/cmd_vel", "linear.y")),
    "The robot stops by itself 0.5 s after the last command: repeat it at 10 Hz, from a timer.":
        lambda run: any(b - a > TIMEOUT for a, b in itertools.pairwise(stamps(run.messages("/cmd_vel")))),
    "The robot turned right. A positive angular.z turns left.":
        lambda run: closest(run.path, (1.0, -1.0))[0] < NEAR,
    "Speed times time must give 1 m for a side and pi/2 rad for a corner. The picture shows what yours gave.":
        lambda run: True,
})
def passes_the_corners(run: Recording) -> None:
    """The robot passes (1, 0), (1, 1), (0, 1) and (0, 0), in this order."""
    passes(run, [*CORNERS, START], tolerance=NEAR)


@square.check(3, after=passes_the_corners, guess="The picture shows where it leaves the square.")
def keeps_to_the_line(run: Recording) -> None:
    """On the way the robot stays within 15 cm of the square's sides."""
    length = traveled(run)
    if length < 3.0:
        expected, saw = "a path along all four sides, 4 m long", f"a path of {length:.2f} m"
        raise Missed(expected, saw, "Drive the whole square first.", picture="path")
    follows(run, [START, *CORNERS, START], tolerance=NEAR)


@square.check(3, after=passes_the_corners, guess="After four sides and four corners, publish zeros.")
def closes_the_square(run: Recording) -> None:
    """After the third corner the robot ends where it started, within 15 cm."""
    try:
        passes(run, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, then the start", missed.saw,
                     "Get the robot around the corners first.") from None
    arrives(run, START, tolerance=NEAR)


@square.check(2, after=passes_the_corners)
def stops_at_the_end(run: Recording) -> None:
    """The robot stands still at the end."""
    stands_still(run)
    ends_with_a_stop(run)
