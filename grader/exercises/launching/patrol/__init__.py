"""A broken package to repair."""

from functools import partial

from grader.checks import Missed, publishes, series
from grader.checks.packages import installs_by_itself, names_what_it_imports
from grader.exercise import Exercise, Scenario
from grader.exercises.launching.patrol.patrol_package import repaired
from grader.responses import same
from grader.workspace.installation import ros2_launch, ros2_run
from grader.workspace.near_misses import judge_only
from grader.workspace.package import PackageRun

__all__ = ["patrol", "repaired"]

TWIST = "geometry_msgs/msg/Twist"
ALONE, LAUNCHED = 0.2, 0.15  # m/s

SCENARIOS = [
    Scenario(seconds=3, name="program", prepare=partial(ros2_run, "patrol", "patrol")),
    Scenario(seconds=4, name="launch", prepare=partial(ros2_launch, "patrol", "patrol.launch.py")),
]

patrol = Exercise("patrol", "A broken package", package="patrol", scenarios=SCENARIOS,
                  near_misses=[judge_only("grader.exercises.launching.patrol.answers:with_one_fault_less")])


@patrol.check(5, only="program")
def program_runs(run: PackageRun) -> None:
    """`ros2 run patrol patrol` publishes Twist messages on /cmd_vel, at 0.2 m/s."""
    publishes(run, "/cmd_vel", TWIST)
    _drives_at(run, "/cmd_vel", ALONE, "The speed is in patrol/speeds.py.")


@patrol.check(5, only="launch")
def launch_file_runs(run: PackageRun) -> None:
    """`ros2 launch patrol patrol.launch.py` starts it for a robot: Twist messages on /scout/cmd_vel."""
    publishes(run, "/scout/cmd_vel", TWIST)


@patrol.check(3, after=launch_file_runs, only="launch")
def settings_hold(run: PackageRun) -> None:
    """That robot drives at 0.15 m/s, as config/patrol.yaml says."""
    hint = "The file begins with the node's name or /**, followed by ros__parameters with two underscores."
    _drives_at(run, "/scout/cmd_vel", LAUNCHED, hint)


@patrol.check(2)
def names_its_needs(run: PackageRun) -> None:
    """package.xml names every ROS package that its modules and its launch file import."""
    names_what_it_imports(run)


@patrol.check(2)
def installs_what_it_has(run: PackageRun) -> None:
    """setup.py installs package.xml, and the marker that lets ROS find the package."""
    installs_by_itself(run)


def _drives_at(run: PackageRun, topic: str, wanted: float, hint: str) -> None:
    for stamp, speed in series(run, topic, "linear.x"):
        if not same(speed, wanted):
            raise Missed(f"{wanted:g} m/s on {topic}", f"{speed:g} m/s at {stamp:.3g} s", hint)
