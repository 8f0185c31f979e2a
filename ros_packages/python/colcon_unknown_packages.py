"""A colcon extension that says in a sentence which package CMake did not find, or which is not valid."""

from __future__ import annotations

import difflib
import os
import re
import sys
from pathlib import Path
from typing import Any

from catkin_pkg.package import InvalidPackage, parse_package
from colcon_core.event.job import JobEnded, JobQueued
from colcon_core.event.output import StderrLine
from colcon_core.event_handler import EventHandlerExtensionPoint

_NOT_FOUND = re.compile(r'find a package configuration file provided by\s+"([^"]+)"')
LIKE_A_TYPO = 0.9  # least similarity of two names to take one for a typo of the other
_INDEX = "share/ament_index/resource_index/packages"


class UnknownPackages(EventHandlerExtensionPoint):
    """Prints a sentence when a build has failed, after CMake's own words, or when a package is not valid."""

    PRIORITY = 60  # after the handlers that show the output, before the summary

    def __init__(self) -> None:
        super().__init__()
        self._queued: set[str] = set()  # the packages of this build
        self._stderr: dict[Any, list[str]] = {}  # by job

    def __call__(self, event: tuple[Any, Any]) -> None:
        """Work like `EventHandlerExtensionPoint`."""
        data, job = event
        if isinstance(data, JobQueued):
            self._queued.add(data.identifier)
            self._report_invalid(data.identifier, job)
        elif isinstance(data, StderrLine):
            self._stderr.setdefault(job, []).append(data.line.decode(errors="replace"))
        elif isinstance(data, JobEnded) and data.rc:
            for name in dict.fromkeys(_NOT_FOUND.findall("".join(self._stderr.pop(job, ())))):
                print(f"{data.identifier}: {explain(name, data.identifier, self._queued)}", file=sys.stderr)

    def _report_invalid(self, identifier: str, job: Any) -> None:
        """Say why colcon takes a ROS package for one without ROS, which `ros2 run` does not find."""
        package = getattr(getattr(job, "task_context", None), "pkg", None)
        file = Path(getattr(package, "path", ""), "package.xml")
        if package is None or package.type.startswith("ros.") or not file.is_file():
            return
        try:
            parse_package(file, warnings=[])
        except (AssertionError, InvalidPackage) as error:
            reason = str(error).splitlines()[-1].removeprefix("- ").rstrip(".")
            print(
                f"{identifier}: its package.xml is not valid: {reason}. It is built without ROS, and ros2 "
                "does not find it.",
                file=sys.stderr,
            )


def explain(name: str, package: str, queued: set[str]) -> str:
    """Return why a package was not found for another one. queued: the names of all packages of the build."""
    if name in queued:
        return (
            f"{name} is a package of this workspace, but {package} does not depend on it, so it is not built "
            f"first. Write <depend>{name}</depend> into the package.xml of {package}."
        )
    known = queued - {package} | _installed()
    near = next(iter(difflib.get_close_matches(name, sorted(known), n=1, cutoff=LIKE_A_TYPO)), "")
    what = f"its CMakeLists.txt requires {name}, which is neither installed nor in this workspace."
    return f"{what} Did you mean {near}?" if near else f"{what} Put its source into src, or remove the line."


def _installed() -> set[str]:
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return {path.name for prefix in prefixes if prefix for path in Path(prefix, _INDEX).glob("*")}
