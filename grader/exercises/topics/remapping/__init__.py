"""Another robot's node, connected to the course's robot by remapping its topics."""

from grader.checks import arrives, ends_with_a_stop, publishes, stands_still, subscribes
from grader.exercise import Exercise
from grader.exercises.topics.remapping.one_meter import OneMeter
from sim.evidence import Recording

__all__ = ["OneMeter", "remapping"]

remapping = Exercise("remapping", "Another robot's node", world="yard", seconds=8, names_count=True)
PAIRS = "A remapping is a pair of names: first the one in the node's code, then the one on the robot."


@remapping.check(4, guess=PAIRS)
def commands_reach_the_robot(run: Recording) -> None:
    """The node's commands go to /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")


@remapping.check(4, guess=PAIRS)
def odometry_reaches_the_node(run: Recording) -> None:
    """The node subscribes to the robot's /odom."""
    subscribes(run, "/odom", "nav_msgs/msg/Odometry")


@remapping.check(4, after=(commands_reach_the_robot, odometry_reaches_the_node),
                 guess="OneMeter drives the meter by itself once both names are right.")
def drives_one_meter(run: Recording) -> None:
    """The robot drives one meter straight on and stops there."""
    arrives(run, (1.0, 0.0), tolerance=0.1)
    stands_still(run)
    ends_with_a_stop(run)
