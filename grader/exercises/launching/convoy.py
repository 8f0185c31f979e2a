"""A launch file that starts one program for each of two robots, under other names and with other settings."""

from functools import partial
from typing import Any

from grader.checks import Missed, publishes
from grader.checks.packages import names_what_it_imports
from grader.exercise import Exercise, Scenario
from grader.geometry.near import is_near
from grader.variants import Variants
from grader.workspace.installation import ros2_launch
from grader.workspace.near_misses import commas, entry_points, executables
from grader.workspace.package import PackageRun
from sim import World

__all__ = ["LANES", "convoy"]

WALL = 2.0  # m: where the wall ahead is; all robots start at 0
SIDES = "left", "right"
REQUESTED = 0.8  # m: for the left one, by an argument
NEAR, MOVED = 0.08, 0.02  # m
LANES = World.from_data({
    "name": "lanes",
    "card": "Picture: Three lanes with a robot in each; 2 m ahead of them is a wall.",
    "start": [0.0, 0.0, 0.0],
    "bounds": [-0.5, -1.8, WALL, 1.8],
    "walls": [[[-0.5, 1.8], [WALL, 1.8], [WALL, -1.8], [-0.5, -1.8]]],
    "robots": [{"name": "left", "start": [0.0, 1.2, 0.0]}, {"name": "right", "start": [0.0, -1.2, 0.0]}],
})


def _launch(*words: str) -> partial[Any]:
    return partial(ros2_launch, "convoy", "two.launch.py", *words)

convoy = Exercise("convoy", "One launch file, two robots", package="convoy", scenarios=[
    Scenario(LANES, seconds=7, name="plain", prepare=_launch()),
    Scenario(LANES, seconds=7, seed=1, name="asked", prepare=_launch(f"gap:={REQUESTED}")),
], near_misses=[commas, entry_points, executables], variants=Variants(
    {"left": (0.5, 0.6, 0.4)},  # m
    {"right": (1.0, 1.2)},
    texts=("**{left} m**", 'default_value="{left}"', "{left} m before",
           "**{right:g} m**", '"right", {right})', "such as `{right}`", "{right:g} m before"),
))


def _ignores_namespaces(run: PackageRun) -> bool:
    """Return whether a node in a robot's namespace publishes on an absolute topic."""
    return any(end.node.startswith(("/left/", "/right/")) for end in run.graph.publishers("/cmd_vel"))


@convoy.check(5, guess={
    "A topic that begins with a slash gets no namespace: the program's is `drive`, remapped to cmd_vel, "
    "both without a slash.": _ignores_namespaces,
    "The launch file needs two Nodes, in the namespaces left and right, with `drive` remapped to "
    "cmd_vel.": lambda _: True,
})
def drives_both(run: PackageRun) -> None:
    """`ros2 launch convoy two.launch.py` drives both robots, through /left/cmd_vel and /right/cmd_vel."""
    for side in SIDES:
        publishes(run, f"/{side}/cmd_vel", "geometry_msgs/msg/Twist")


@convoy.check(2, after=drives_both)
def leaves_the_third_alone(run: PackageRun) -> None:
    """The robot in the middle has no driver: it stays where it is."""
    moved = abs(run.path[-1].x - run.path[0].x)
    if moved > MOVED:
        hint = "An extra program drives it: give each Node in the launch file a namespace, left or right."
        raise Missed("a middle robot that stands still", f"{moved:.2f} m", hint, picture="path")


@convoy.check(3, after=drives_both)
def right_keeps_its_distance(run: PackageRun) -> None:
    """The right robot stops 1 m before the wall, whatever the argument."""
    _stops(run, "right", convoy.drawn.right, f'Give its Node parameters=[{{"gap": {convoy.drawn.right}}}].')


@convoy.check(3, after=drives_both, only="plain")
def left_keeps_its_distance(run: PackageRun) -> None:
    """The left robot stops 0.5 m before the wall without an argument."""
    gap = convoy.drawn.left
    hint = f'Declare the default: DeclareLaunchArgument("gap", default_value="{gap}").'
    _stops(run, "left", gap, hint)


@convoy.check(3, after=drives_both, only="asked")
def left_obeys_the_argument(run: PackageRun) -> None:
    """With the argument gap:=0.8 the left robot stops 0.8 m before the wall."""
    _stops(run, "left", REQUESTED, 'Give its Node parameters=[{"gap": LaunchConfiguration("gap")}].')


@convoy.check(2)
def names_its_needs(run: PackageRun) -> None:
    """package.xml names every ROS package that its modules and its launch file import."""
    names_what_it_imports(run)


def _stops(run: PackageRun, side: str, gap: float, hint: str) -> None:
    left = WALL - run.tracks[side][-1].x
    if not is_near(left, gap, NEAR):
        raise Missed(f"the {side} robot {gap:g} m before the wall", f"{left:.2f} m", hint, picture="path")
