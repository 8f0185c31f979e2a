"""A student's package as data, for the checks of exercises."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Self

from grader.diagnosis.fault import NOT_STARTED, Fault
from grader.workspace.build_errors import explain_build_error
from grader.workspace.building import Build, Built
from grader.workspace.interfaces import Interfaces
from grader.workspace.package_xml import CMAKE, PYTHON, PackageXml, parse_package_xml
from grader.workspace.sources import InvalidFiles, Sources, validate_files
from sim.evidence import Recording

STUB = b"raise NotImplementedError()"
MAX_TEXT = 500  # characters of a text from another process


@dataclass(frozen=True)
class Package:
    """A package: its sources, its package.xml, and the result of the build.

    The build of a package of interfaces may have failed: its checks look at the sources as well.
    """

    sources: Sources
    package_xml: PackageXml
    built: Built


@dataclass
class PackageRun(Recording):
    """A run of a package's programs, and the package."""

    package: Package | None = None

    @classmethod
    def of(cls, recording: Recording, package: Package) -> Self:
        """The recording together with the package."""
        values = {one.name: getattr(recording, one.name) for one in fields(Recording)}
        return cls(**values, package=package)


def make_package(name: str, received: Any, build: Build, build_type: str = PYTHON) -> Package | Fault:
    """The package of the sources that `serialize_sources` returned, or a fault for the student.

    build_type: the required one in package.xml.
    """
    if received is None:
        return _not_started(f"the cell above, about {name}")
    if isinstance(received, str):
        return _fault("a workspace with your package", received[:MAX_TEXT])
    try:
        sources = validate_files(received, f"ws/src/{name}")
        if any(STUB in data for data in sources.values()):
            return _not_started("ws/src/" + next(path for path, data in sources.items() if STUB in data))
        package_xml = parse_package_xml(sources, name, build_type)
        built = build(sources)
    except InvalidFiles as reason:
        return _fault("a package that can be built", str(reason))
    if built.problem and build_type != CMAKE:
        setup = sources.get(f"{name}/setup.py", b"").decode("utf-8", "replace")
        saw, hint = explain_build_error(built, setup)
        return _fault("a package that can be built", saw, hint)
    return Package(sources, package_xml, built)


def with_interfaces(package: Package, uses: Interfaces, received: Any, build: Build) -> Package | Fault:
    """The package with the types that it uses, built from the sources of the same workspace; or a fault.

    received: the interface package's sources, as for `make_package`.
    """
    made = make_package(uses.name, received, build, CMAKE)
    saw = made.saw if isinstance(made, Fault) else made.built.problem or uses.difference(made.built.files)
    if isinstance(made, Fault) or saw:
        expected = f"{uses.name} with the types that the task describes"
        hint = f"Earn the points for {uses.name} first: the check there shows what is missing."
        return replace(_fault(expected, saw, hint), sentence="The types that your package uses are built.")
    return replace(package, built=package.built.with_files_of(made.built))


def _fault(expected: str, saw: str, hint: str = "") -> Fault:
    if not hint:  # an InvalidFiles: the first sentence is the observation, the others are the hint
        end = saw.find(". ") + 1
        saw, hint = (saw[: end - 1], saw[end + 1 :]) if end else (saw, "")
    texts = _plain(saw), _plain(hint)
    return Fault(expected, *texts, before_start=True, sentence="Your package is built.")


def _plain(text: str) -> str:
    """The text without control characters."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


def _not_started(place: str) -> Fault:
    return Fault(
        expected="your own lines instead of `raise NotImplementedError()`",
        saw=f"This exercise is not started yet: that line is still in {place}",
        hint="Write your lines, delete the line that raises, and run this cell and the one below again.",
        before_start=True,
        sentence=NOT_STARTED,
    )
