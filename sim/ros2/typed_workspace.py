"""The workspace of a typed session: its packages, new ones too, and what is built of it.

A new package has only what `ros2 pkg create` writes, so it is installed without colcon.
"""

from __future__ import annotations

import itertools
import posixpath
import re
from collections.abc import Sequence, Set
from pathlib import Path

from sim.ros.workspaces import INDEX
from sim.ros2.group import UsageError
from sim.ros2.parser import make_parser
from sim.ros2.system import CliError, Output
from sim.ros2.typed_lines import InvalidLine
from sim.ros2.verbs.pkg_create import Disk, create_package

WORKSPACE = "ws"  # the folder in which `colcon build` is typed
HOME = "/home/you"
NAME = re.compile(r"[A-Za-z][\w-]*")
SELECT = re.compile(r"--packages-(?:select|up-to)")
NEW = "created\n"  # text of the marker of a new package, by which the next session finds it


class TypedWorkspace:
    """The packages of a session, and those that are built. prefix: where the given ones are installed."""

    def __init__(self, prefix: Path) -> None:
        self._prefix, self._markers = prefix, prefix / INDEX / "packages"
        for marker in self._markers.glob("*"):
            if marker.read_bytes() == NEW.encode():  # of an earlier session
                marker.unlink()
        self.packages = {path.name for path in self._markers.glob("*")}
        self.built: set[str] = set()
        self._new: dict[str, _NewFiles] = {}

    def create(self, folder: str, words: Sequence[str]) -> None:
        """Create what `ros2 pkg create` would in this folder. Raises InvalidLine."""
        try:
            options = make_parser(typed=words[1:]).parse_args(words[1:])
            for name in (options.package_name, options.node_name or "main"):
                if not NAME.fullmatch(name):
                    raise CliError(f"'{name}' is no name: use letters, digits and underscores")
            options.maintainer_name = options.maintainer_name or "you"
            options.maintainer_email = options.maintainer_email or "you@example.org"
            files = _NewFiles(folder, set(self._new))
            create_package(Output(print), options, files)
        except (UsageError, CliError) as error:
            raise InvalidLine(str(error).strip()) from None
        except SystemExit:  # --help
            return
        if WORKSPACE in files.absolute(options.destination_directory).split("/"):
            self._new[options.package_name] = files
            self.packages.add(options.package_name)

    def build(self, folder: str, words: Sequence[str]) -> None:
        """Build what `colcon build` would in this folder. Raises InvalidLine."""
        selected = _selected(words)
        reason = f"type colcon build in the workspace, the folder {WORKSPACE}"
        if posixpath.basename(folder) == WORKSPACE:
            unknown = [name for name in selected if name not in self.packages]
            reason = f"there is no package '{unknown[0]}'" if unknown else ""
        if reason:
            raise InvalidLine(f"Summary: 0 packages finished: {reason}")
        built = set(selected) or self.packages
        for name in self._new.keys() & built:
            self._install(name, self._new[name])
        self.built |= built
        print(f"Summary: {len(built)} package{'s' * (len(built) > 1)} finished")

    def require(self, sourced: Set[str], words: Sequence[str]) -> None:
        """Raise InvalidLine if a terminal that sourced these packages doesn't find one of the words."""
        missing = sorted(self.packages.intersection(words) - sourced)
        if not missing:
            return
        reason = f"source {WORKSPACE}/install/setup.bash was not typed in this terminal"
        if sourced:
            reason = f"source {WORKSPACE}/install/setup.bash again, because it was built later"
        if missing[0] not in self.built:
            reason = "it is not built"
        raise InvalidLine(f"Package '{missing[0]}' not found: {reason}")

    def _install(self, name: str, files: _NewFiles) -> None:
        installed = {f"{INDEX}/packages/{name}": NEW, f"share/{name}/package.xml": files.texts["package.xml"]}
        for path, text in files.texts.items():
            folder, _, file = path.rpartition("/")
            if folder == name and file != "__init__.py":
                installed[f"lib/{name}/{file.removesuffix('.py')}"] = f"#!/usr/bin/env python3\n{text}"
        for path, text in installed.items():
            target = self._prefix / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
            target.chmod(0o755)


class _NewFiles(Disk):
    """The files of a new package, which nothing writes. folder: the terminal's. existing: names of others."""

    def __init__(self, folder: str, existing: Set[str]) -> None:
        self.texts: dict[str, str] = {}  # by their paths in the package
        self._folder, self._existing = folder, existing

    def absolute(self, folder: str) -> str:
        return posixpath.normpath(posixpath.join(HOME, self._folder.removeprefix("~/"), folder))

    def exists(self, folder: str) -> bool:
        return posixpath.basename(folder) in self._existing

    def write(self, folder: str, path: str, text: str | None) -> None:
        if text is not None:
            self.texts[path] = text

    def copy(self, source: Path, folder: str, path: str) -> None:
        """Leave it out: when a class is marked, the student's process can't read the course's LICENSE."""


def _selected(words: Sequence[str]) -> list[str]:
    """The packages that a colcon command selects; none for all."""
    at = next((number for number, word in enumerate(words, 1) if SELECT.fullmatch(word)), len(words))
    return list(itertools.takewhile(lambda word: not word.startswith("-"), words[at:]))
