"""Finds launch files by the arguments of `ros2 launch`, and loads them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from sim.ros.packages import why_no_package
from sim.suggestions import closest_match

BUNDLED_FILES = Path(__file__).parent / "bundled"  # launch files of ROS packages, unless installed
SUFFIXES = (".py", ".yaml", ".yml", ".xml", ".launch")


class NoLaunchFile(Exception):
    """There is no such launch file. Its message is upstream's, and what to do."""


def find_launch_file(arguments: Sequence[str]) -> tuple[str, list[str]]:
    """The path of a launch file, named by a path or by a package and a file, and the remaining arguments.

    Raises NoLaunchFile.
    """
    first, *rest = arguments
    if os.path.isfile(first):
        return first, rest
    if not rest or ":=" in rest[0]:
        if os.sep in first or Path(first).suffix in SUFFIXES:
            folder = Path(first).absolute().parent
            near = _suggestion(Path(first).name, [*folder.glob("*"), *folder.glob("launch/*")])
            raise NoLaunchFile(f"There is no launch file {first!r} in {os.getcwd()}.{near.removeprefix('.')}")
        raise NoLaunchFile(f"Package '{first}' has launch files: name one, as in {first} bringup.launch.py.")
    return _in_package(first, rest[0]), rest[1:]


def _in_package(package: str, file: str) -> str:
    try:
        share = get_package_share_directory(package)
    except PackageNotFoundError:
        raise NoLaunchFile(f"Package '{package}' not found: {why_no_package(package)}") from None
    except ValueError as error:
        raise NoLaunchFile(f"Package '{package}' not found: {error}") from None
    paths = _matches(Path(share), file) or _matches(BUNDLED_FILES / package, file)
    if not paths:
        raise NoLaunchFile(
            f"file '{file}' was not found in the share directory of package '{package}' which is at '{share}'"
            f"{_suggestion(file, [*Path(share).rglob('*'), *(BUNDLED_FILES / package).rglob('*')])}"
        )
    if len(paths) > 1:
        shown = ", ".join(f"'{path}'" for path in paths)
        raise NoLaunchFile(
            f"file '{file}' was found more than once in the share directory of package '{package}': [{shown}]"
        )
    return paths[0]


def _matches(folder: Path, name: str) -> list[str]:
    return sorted(str(path) for path in folder.rglob(name) if path.is_file())


def _suggestion(name: str, files: Iterable[Path]) -> str:
    """The launch file among these whose name is nearly this one, as a sentence; "" if there is none.

    Suffixes alone make no two names alike.
    """
    names = sorted({path.name for path in files if path.suffix in SUFFIXES})
    if ".launch." in name:  # settings in YAML are no launch file
        names = [other for other in names if ".launch." in other]
    stem = closest_match(name.split(".")[0], {each.split(".")[0] for each in names})
    near = closest_match(name, [each for each in names if stem and each.split(".")[0] == stem], 0.0)
    return f". Did you mean '{near}'?" if near else ""


def parse_arguments(arguments: Iterable[str]) -> dict[str, str]:
    """Name to value of arguments NAME:=VALUE; the last value of a name wins. Raises NoLaunchFile."""
    values = {}
    for argument in arguments:
        name, separator, value = argument.partition(":=")
        if not (name and separator and value):
            raise NoLaunchFile(f"malformed launch argument '{argument}', expected format '<name>:=<value>'")
        values[name] = value
    return values


def load_description(path: str, arguments: Iterable[str]) -> Any:
    """A launch description that includes a file with these arguments. Raises NoLaunchFile."""
    from launch import LaunchDescription  # imported late, because it is slow and few runs need it
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    given = list(parse_arguments(arguments).items())
    return LaunchDescription(
        [IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=given)]
    )
