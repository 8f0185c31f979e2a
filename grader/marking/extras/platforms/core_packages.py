"""The part of requirements.lock that judging needs: an image is small, and has the versions of here."""

import re
import tomllib
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from grader.marking.errors import CourseError

MACHINE = {"sys_platform": "linux", "platform_machine": "x86_64"}
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
COMPILED = ("ros2-course-interfaces", "ros2-course-lidar")  # their wheels are in the bundle
PINNED = re.compile(r"^([A-Za-z0-9][A-Za-z0-9._-]*)==(?:[^\n]*\\\n)*[^\n]*", re.M)  # with its hashes


def pinned_requirements(course: Path, everything: bool) -> str:
    """The lines of requirements.lock for the packages that judging imports; for all if `everything`.

    Raises CourseError if one of them isn't installed here.
    """
    text = (course / "requirements.lock").read_text(encoding="utf-8")
    needed = None if everything else needed_packages(course)
    found = (each for each in PINNED.finditer(text) if not needed or canonicalize_name(each[1]) in needed)
    return "\n".join(filter(None, (_for_containers(each[0]) for each in found))) + "\n"


def _for_containers(entry: str) -> str:
    """The entry without a marker that always holds on x86_64; "" if it never does.

    An old pip takes "3.11.0rc1", which Ubuntu 22.04 has, for a version that isn't below 3.15.
    """
    first, *hashes = entry.split("\n")
    pinned = Requirement(first.removesuffix("\\"))
    if pinned.marker is None:
        return entry
    holds = {pinned.marker.evaluate(MACHINE | {"python_full_version": f"{each}.9"}) for each in PYTHONS}
    if len(holds) > 1:
        return entry
    return "\n".join([f"{first.partition(' ; ')[0]} \\", *hashes]) if holds.pop() else ""


def needed_packages(course: Path) -> set[str]:
    """The course's own dependencies, and all that these need, by canonical name. Raises CourseError."""
    project = tomllib.loads((course / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    left, found = list(_applicable(project["dependencies"], {""})), set()
    while left:
        requirement = left.pop()
        name = canonicalize_name(requirement.name)
        key = name, frozenset(requirement.extras)
        if name in COMPILED or key in found:
            continue
        found.add(key)
        try:
            needs = metadata.requires(name) or []
        except metadata.PackageNotFoundError:
            raise CourseError(f"{name} is not installed: run `make tools` first") from None
        left += _applicable(needs, {"", *requirement.extras})
    return {name for name, _ in found}


def _applicable(lines: list[str], extras: set[str]) -> Iterator[Requirement]:
    """The requirements that hold on this kind of machine with these extras."""
    for line in lines:
        requirement = Requirement(line)
        marker = requirement.marker
        if marker is None or any(marker.evaluate({"extra": extra}) for extra in extras):
            yield requirement
