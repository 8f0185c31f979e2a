"""The course's own build of types that students define, for a judge.

A judge decodes what a student's process sends, so it needs the types as well. It uses those of the right
definitions: the code that a build made of a student's definitions runs in the student's process only.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from grader.workspace.building import Build
from grader.workspace.interfaces import MODULES, Interfaces
from sim.ros.remote import trust_types_in

_provided: dict[str, Path] = {}  # the folder of each package's types in this process


def provide(interfaces: Interfaces, build: Build) -> None:
    """Make the types importable in this process, and valid in messages of other processes.

    Raises RuntimeError if they can't be built, which is a mistake of the course or of this machine.
    """
    if interfaces.name in _provided:
        return
    built = build(interfaces.sources)
    problem = built.problem or interfaces.difference(built.files)
    if problem:
        raise RuntimeError(f"The course's own {interfaces.name} can't be built: {problem}\n{built.output}")
    folder = Path(tempfile.mkdtemp(prefix="types-"))
    for path, data in built.files.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    modules = str(folder / MODULES)
    sys.path.append(modules)
    trust_types_in(modules)
    _provided[interfaces.name] = folder
