"""The student's programs for a run: in this process, or in another one that is not trusted."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, Protocol

from grader.diagnosis.fault import Fault
from grader.grade_arguments import outdated_code, refusal, unusable_argument
from grader.workspace import building, installation
from grader.workspace.building import Build
from grader.workspace.interfaces import Interfaces
from grader.workspace.judge_types import provide
from grader.workspace.near_misses import Correction, corrected
from grader.workspace.package import Package, make_package, with_interfaces
from sim.ros.remote import Remote, RemoteLost
from sim.ros.remote.serving import prepared

Prepare = Callable[[Any], Any]
"""Makes of one of the student's programs the one that runs in its place, or a list of those: a function of a
module, or functools.partial of one with further words."""

Corrections = Sequence[Correction]
_SAME = object()  # in place of sources that no correction changes
MOST_TEXT = 2_000  # characters of a text that another process sends


class ProgramSource(Protocol):
    """The student's programs, wherever they live."""

    def refusal(self) -> Fault | None:
        """Return why they can't be run; None when they can."""

    def programs(self, prepare: Prepare | None = None) -> Sequence[Any]:
        """Return what `sim.run` takes in their place. prepare: is done to each of them, where it lives."""

    def package(
        self, name: str, build_type: str, uses: Interfaces | None = None, corrections: Corrections = ()
    ) -> Package | Fault | None:
        """The package of this name and type in the workspace that was handed over, built anew and installed
        where its programs live; or why there is none.

        uses: a package of interfaces there that is installed beside it. corrections: of near misses. With
        these it is the corrected package, or None if nothing is corrected.
        """

    def leave(self) -> None:
        """Remove what `package` installed: it is needed no more."""


class LocalPrograms:
    """Programs in this process: Node classes, callables that return a node, main() functions.

    Or the folder of a workspace, whose packages `build` builds.
    """

    def __init__(self, nodes: Sequence[Any], build: Build | None = None) -> None:
        self._nodes, self._build = nodes, build or building.build

    def refusal(self) -> Fault | None:
        """See ProgramSource."""
        return outdated_code(self._nodes) or refusal(self._nodes)

    def programs(self, prepare: Prepare | None = None) -> Sequence[Any]:
        """See ProgramSource."""
        return prepared(self._nodes, *_parts(prepare))

    def package(
        self, name: str, build_type: str, uses: Interfaces | None = None, corrections: Corrections = ()
    ) -> Package | Fault | None:
        """See ProgramSource."""
        folders = [Path(node, "src", name) for node in self._nodes if isinstance(node, str)]
        if outdated := outdated_code(folders):
            return outdated
        read = functools.partial(installation.serialize_sources, self._nodes)
        made = _made(read, self._build, name, build_type, uses, corrections)
        if isinstance(made, Package):
            installation.install(made.built.files, made.built.programs)
        return made

    def leave(self) -> None:
        """See ProgramSource."""
        installation.uninstall()


class RemotePrograms:
    """Programs in the process at the other end of `remote`, which does as it likes.

    build: builds packages, on this side.
    Every method raises RemoteLost when that process is gone, silent, or sends what can't be.
    """

    def __init__(self, remote: Remote, build: Build | None = None) -> None:
        self._remote, self._build = remote, build or _refuse_to_build

    def refusal(self) -> Fault | None:
        """See ProgramSource. The other process answers."""
        answer = self._remote.call(_name(plain_refusal))
        if answer is None:
            return None
        if not isinstance(answer, list) or [type(part) for part in answer] != [str, str]:
            raise RemoteLost("The process with the nodes did not report whether they can be run.", lives=True)
        return unusable_argument(*(part[:MOST_TEXT].encode("utf-8", "replace").decode() for part in answer))

    def programs(self, prepare: Prepare | None = None) -> Sequence[Any]:
        """See ProgramSource."""
        return [self._remote.program(serialize_preparation(prepare))]

    def package(
        self, name: str, build_type: str, uses: Interfaces | None = None, corrections: Corrections = ()
    ) -> Package | Fault | None:
        """See ProgramSource. The other process sends the sources and installs what was built."""
        read = functools.partial(self._remote.call, _name(installation.serialize_sources))
        made = _made(read, self._build, name, build_type, uses, corrections)
        if isinstance(made, Package):
            if uses:
                provide(uses, self._build)
            built = installation.serialize_installation(made.built)
            self._remote.call(_name(installation.install_remotely), *built)
        return made

    def leave(self) -> None:
        """See ProgramSource. The other process ends soon, and it is the student's."""


def _made(
    read: Callable[[str], Any],
    build: Build,
    name: str,
    build_type: str,
    uses: Interfaces | None,
    corrections: Corrections,
) -> Package | Fault | None:
    """The package, built; None if there are corrections and none applies.

    read: returns the sources of the package of this name, as `serialize_sources` does.
    """
    sources = _corrected(read(name), corrections)
    if sources is _SAME:
        return None
    made = make_package(name, sources, build, build_type)
    if uses and isinstance(made, Package):
        return with_interfaces(made, uses, read(uses.name), build)
    return made


def _parts(prepare: Prepare | None) -> tuple[Callable[..., Any] | None, Sequence[Any]]:
    """The function, and its further words."""
    return (prepare.func, prepare.args) if isinstance(prepare, functools.partial) else (prepare, ())


def _corrected(received: Any, corrections: Corrections) -> Any:
    """The sources that were received, corrected; `_SAME` if there are corrections and none applies."""
    if not corrections:
        return received
    valid = isinstance(received, dict) and all(isinstance(data, bytes) for data in received.values())
    made = corrected(received, corrections) if valid else None
    return _SAME if made is None else made


def _refuse_to_build(_: Any) -> NoReturn:
    raise ValueError("RemotePrograms needs its `build` for an exercise with a package")


def plain_refusal(nodes: Sequence[Any]) -> list[str] | None:
    """Return the other process's answer: what it saw instead of programs, and a hint; None if all is well."""
    fault = refusal(nodes)
    return None if fault is None else [fault.saw, fault.hint]


def serialize_preparation(prepare: Prepare | None) -> list[Any]:
    """Return a preparation in a form to send: its function's name and arguments; [] for none."""
    function, arguments = _parts(prepare)
    return [] if function is None else [_name(function), *arguments]


def _name(function: Callable[..., Any]) -> str:
    """Return what the other process finds the function by."""
    return f"{function.__module__}:{function.__qualname__}"
