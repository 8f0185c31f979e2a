"""Which launch file is meant by some words, and what it is given."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

BUNDLED_FILES = Path(__file__).parent / "bundled"  # launch files of ROS packages, unless installed
KINDS = (".py", ".yaml", ".yml", ".xml", ".launch")


class NoLaunchFile(Exception):
    """There is no such launch file. Its words are upstream's."""


def found(words: Sequence[str]) -> tuple[str, list[str]]:
    """The path of a launch file, and the words after those that name it: a path, or a package and a file.

    Raises NoLaunchFile.
    """
    first, *rest = words
    if os.path.isfile(first):
        return first, rest
    if not rest or ":=" in rest[0]:
        if os.sep in first or Path(first).suffix in KINDS:
            raise NoLaunchFile(f"There is no launch file {first!r} in {os.getcwd()}.")
        raise NoLaunchFile(f"Package '{first}' has launch files: say which, as in {first} bringup.launch.py.")
    return _in_package(first, rest[0]), rest[1:]


def _in_package(package: str, file: str) -> str:
    try:
        share = get_package_share_directory(package)
    except (PackageNotFoundError, ValueError) as error:
        raise NoLaunchFile(f"Package '{package}' not found: {error}") from None
    paths = _files(Path(share), file) or _files(BUNDLED_FILES / package, file)
    if not paths:
        raise NoLaunchFile(
            f"file '{file}' was not found in the share directory of package '{package}' which is at '{share}'"
        )
    if len(paths) > 1:
        shown = ", ".join(f"'{path}'" for path in paths)
        raise NoLaunchFile(
            f"file '{file}' was found more than once in the share directory of package '{package}': [{shown}]"
        )
    return paths[0]


def _files(folder: Path, name: str) -> list[str]:
    return sorted(str(path) for path in folder.rglob(name) if path.is_file())


def arguments(words: Iterable[str]) -> dict[str, str]:
    """Name to value of words such as NAME:=VALUE; the last one counts. Raises NoLaunchFile."""
    values = {}
    for word in words:
        name, between, value = word.partition(":=")
        if not (name and between and value):
            raise NoLaunchFile(f"malformed launch argument '{word}', expected format '<name>:=<value>'")
        values[name] = value
    return values


def description(path: str, words: Iterable[str]) -> Any:
    """The launch description that includes a file with such arguments."""
    from launch import LaunchDescription  # here, for it takes a while, and most runs do without
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    given = list(arguments(words).items())
    return LaunchDescription(
        [IncludeLaunchDescription(AnyLaunchDescriptionSource(path), launch_arguments=given)]
    )
