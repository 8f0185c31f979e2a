"""A broken package: a number says which faults it has."""

from __future__ import annotations

import functools
import os
import random
from collections.abc import Callable
from pathlib import Path

from grader.checks import Missed, publishes, series
from grader.exercise import Exercise, Scenario
from grader.exercises.packages.looks import installs_by_itself, names_what_it_imports
from grader.exercises.packages.patrol import FAULTS, FILES
from grader.workspace import place
from grader.workspace.package import PackageRun

FAULTY = 6
Place = str | os.PathLike[str]
TWIST = "geometry_msgs/msg/Twist"
ALONE, LAUNCHED = 0.2, 0.15  # m/s

patrol = Exercise(
    "patrol",
    "A broken package",
    package="patrol",
    scenarios=[
        Scenario(seconds=3, name="program", prepare=functools.partial(place.program, "patrol", "patrol")),
        Scenario(
            seconds=4,
            name="launch",
            prepare=functools.partial(place.launched, "patrol", "patrol.launch.py"),
        ),
    ],
)


Mend = Callable[[str, str, str], None]


def broken(workspace: Place, number: int) -> None:
    """Write the package patrol into a workspace, with six faults that this number draws.

    What stands there is written anew.
    """
    for path, text in faulty(number).items():
        file = Path(workspace) / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def mended(workspace: Place, number: int, repair: Callable[[Mend], None]) -> Place | None:
    """Write the broken package anew, let `repair` mend it, and give the workspace; None where it isn't begun.

    repair: a function of `mend`, which takes a file of the package, such as "setup.py", a text that it has
    once, and the text that takes its place.
    """
    broken(workspace, number)
    try:
        repair(functools.partial(_mend, workspace))
    except NotImplementedError:
        return None
    return workspace


def faulty(number: int) -> dict[str, str]:
    """The files of the package with six faults: path below src/ to text."""
    files = dict(FILES)
    for path, right, wrong in random.Random(f"faults {number}").sample(FAULTS, FAULTY):
        files[path] = files[path].replace(right, wrong)
    return files


def _mend(workspace: Place, file: str, old: str, new: str) -> None:
    """Raises ValueError where the file has no `old`, or more than one, and FileNotFoundError for no file."""
    path = Path(workspace) / "src" / "patrol" / file
    text = path.read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"{file} has {text.count(old)} times {old!r}: give a text that it has once.")
    path.write_text(text.replace(old, new), encoding="utf-8")


@patrol.check(5, only="program")
def program_runs(run: PackageRun) -> None:
    """`ros2 run patrol patrol` publishes Twist messages on /cmd_vel, at 0.2 m/s."""
    publishes(run, "/cmd_vel", TWIST)
    _drives_at(run, "/cmd_vel", ALONE, "patrol/speeds.py has the speed.")


@patrol.check(5, only="launch")
def launch_file_runs(run: PackageRun) -> None:
    """`ros2 launch patrol patrol.launch.py` starts it for a robot: Twist messages on /scout/cmd_vel."""
    publishes(run, "/scout/cmd_vel", TWIST)


@patrol.check(3, after=launch_file_runs, only="launch")
def settings_hold(run: PackageRun) -> None:
    """There it drives at 0.15 m/s, as config/patrol.yaml says."""
    hint = "The file begins with the node's name or /**, then comes ros__parameters with two underscores."
    _drives_at(run, "/scout/cmd_vel", LAUNCHED, hint)


@patrol.check(2)
def names_its_needs(run: PackageRun) -> None:
    """package.xml names each ROS package that its modules and its launch file import."""
    names_what_it_imports(run)


@patrol.check(2)
def installs_what_it_has(run: PackageRun) -> None:
    """setup.py installs package.xml, and the marker by which ROS finds the package."""
    installs_by_itself(run)


def _drives_at(run: PackageRun, topic: str, wanted: float, hint: str) -> None:
    for stamp, speed in series(run, topic, "linear.x"):
        if abs(speed - wanted) > 1e-6:
            raise Missed(f"{wanted:g} m/s on {topic}", f"{speed:g} m/s at {stamp:.3g} s", hint)
