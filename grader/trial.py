"""Builds and runs a package as its exercise does, in a notebook."""

from __future__ import annotations

import os
import textwrap

from grader.checks import Missed
from grader.checks.interface_definitions import PARTS, read_definition
from grader.checks.packages import build_warnings
from grader.diagnosis.fault import NOT_STARTED, Fault
from grader.exercise import Exercise
from grader.programs import LocalPrograms
from grader.tell import BEGIN, tell
from grader.workspace.building import CannotBuildHere
from grader.workspace.interfaces import type_names
from grader.workspace.package import Package
from grader.workspace.package_xml import CMAKE
from sim.evidence import Recording


def see(exercise: Exercise, workspace: str | os.PathLike[str] | None, scenario: int = 0) -> Recording:
    """Build the package of an exercise, and run one of its scenarios.

    workspace: the folder with src/ in it. What goes wrong is printed, and what the build warns about; the
    recording of a package that can't be built is empty. No points are given. Of a package of interfaces, what
    it defines is printed.
    """
    source = LocalPrograms((workspace,))
    try:
        found = source.package(exercise.package, exercise.build_type, exercise.uses)
        if isinstance(found, Fault):
            print(BEGIN if found.sentence == NOT_STARTED else f"{found.saw}\nHint: {found.hint}")
            return Recording()
        assert found is not None, "only exercises with a package are looked at"
        if exercise.build_type == CMAKE:
            _print_definitions(found)
            print(found.built.problem or f"Built: {', '.join(type_names(found.built.files))}")
            return Recording()
        for warning in build_warnings(found):
            print(f"The build warns: {warning}")
        chosen, seed = exercise.runs()[scenario]
        recording = chosen.run(source, seed, found)
        tell(recording)
        return recording
    except CannotBuildHere:
        print("Nothing can be built here: when a class is marked, the test cell below does it.")
        return Recording()
    finally:
        source.leave()


def _print_definitions(package: Package) -> None:
    """Print what rosidl reads in the definitions, as `ros2 interface show` does; or why it reads nothing."""
    name = package.package_xml.name
    for path, data in package.sources.items():
        stem, _, kind = path.rpartition(".")
        if kind in PARTS:
            print(stem)
            try:
                parts = read_definition(path.removeprefix(f"{name}/"), data, name).values()
                text = "\n---\n".join(map(str, parts))
            except Missed as missed:
                text = f"{missed.saw}\nHint: {missed.hint}"
            print(textwrap.indent(text, "    "))
