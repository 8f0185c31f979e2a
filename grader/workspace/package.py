"""A student's package as data: what exercises look at besides what its programs did."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Self

from grader.diagnosis.fault import NOT_STARTED, Fault
from grader.workspace.building import Build, Built
from grader.workspace.description import CMAKE, PYTHON, Description, describe
from grader.workspace.reasons import why
from grader.workspace.sources import Refused, Sources, checked
from sim.evidence import Recording

STUB = b"raise NotImplementedError()"
MOST_TEXT = 500  # characters of what another process says


@dataclass(frozen=True)
class Package:
    """A package that was built: its sources, what it says of itself, and what was installed.

    One of interfaces is only read: to build it takes most of a minute, and its sources tell what is in it.
    """

    sources: Sources
    description: Description
    built: Built


@dataclass
class PackageRun(Recording):
    """A run of a package's programs, and the package."""

    package: Package | None = None

    @classmethod
    def of(cls, recording: Recording, package: Package) -> Self:
        """The recording with the package beside it."""
        told = {one.name: getattr(recording, one.name) for one in fields(Recording)}
        return cls(**told, package=package)


def make_package(name: str, told: Any, build: Build, build_type: str = PYTHON) -> Package | Fault:
    """The package of what `told_sources` has told; or why there is none, in words for the student.

    build_type: that of its package.xml.
    """
    if told is None:
        return _not_started(f"the cell above, about {name}")
    if isinstance(told, str):
        return _fault("a workspace with your package", told[:MOST_TEXT])
    try:
        sources = checked(told, f"ws/src/{name}")
        if any(STUB in data for data in sources.values()):
            return _not_started("ws/src/" + next(path for path, data in sources.items() if STUB in data))
        description = describe(sources, name, build_type)
        built = Built() if build_type == CMAKE else build(sources)
    except Refused as reason:
        return _fault("a package that can be built", str(reason))
    if built.problem:
        saw, hint = why(built)
        return _fault("a package that can be built", saw, hint)
    return Package(sources, description, built)


def _fault(expected: str, saw: str, hint: str = "") -> Fault:
    if not hint:  # a refusal: the first sentence says what was seen, the others what to do
        end = saw.find(". ") + 1
        saw, hint = (saw[: end - 1], saw[end + 1 :]) if end else (saw, "")
    words = _plain(saw), _plain(hint)
    return Fault(expected, *words, before_start=True, sentence="Your package is built.")


def _plain(text: str) -> str:
    """Without what a terminal would take for a command."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


def _not_started(place: str) -> Fault:
    return Fault(
        expected="your own lines instead of `raise NotImplementedError()`",
        saw=f"This exercise is not started yet: that line still is in {place}",
        hint="Write your lines, delete the line that raises, and run this cell and the one below again.",
        before_start=True,
        sentence=NOT_STARTED,
    )
