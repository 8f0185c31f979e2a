"""A package of interfaces: its build in seconds, and the types that another package uses of it.

The generators of rosidl and the compilers are those that colcon would start. CMake, C++ and the files for
other CMake packages are left out: rclpy needs none of them, and they take most of a minute. CMakeLists.txt is
not executed; what it hands to rosidl_generate_interfaces is built.
"""

from __future__ import annotations

import json
import re
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.workspace.sources import InvalidFiles, Sources
from sim.course_folders import ROS_PACKAGES

TOOLS = ROS_PACKAGES / "interfaces"
MODULES = f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"
FAILED = "The types could not be built."
CMAKE_LISTS = "CMakeLists.txt"
_DEFINITION = re.compile(r"\b(?:msg|srv|action)/\w+\.(?:msg|srv|action)\b")
_COMMENT = re.compile(r"#.*")
_HANDED_OVER = re.compile(r"rosidl_generate_interfaces\s*\(([^)]*)\)")
_USED = re.compile(r"^\s*(\w+)/\w+", re.M)


@dataclass(frozen=True)
class Interfaces:
    """An interface package that students write, and that their package of another exercise uses.

    definitions: the right ones, by path below the package, such as "msg/Crate.msg". The course's programs
    are built with these. types: names, such as "msg/Crate", with their type hashes, which are equal for equal
    fields.
    """

    name: str
    definitions: Mapping[str, str]
    types: Mapping[str, str]

    @property
    def sources(self) -> dict[str, bytes]:
        """The files that a build of the right definitions needs."""
        used = " ".join({other for text in self.definitions.values() for other in _USED.findall(text)})
        command = f"rosidl_generate_interfaces({' '.join(self.definitions)} DEPENDENCIES {used})"
        files = {**self.definitions, CMAKE_LISTS: command}
        return {f"{self.name}/{path}": text.encode() for path, text in files.items()}

    def difference(self, files: Mapping[str, bytes]) -> str:
        """Return which type is missing among the built files or has other fields; "" for none."""
        for type_, wanted in self.types.items():
            built = type_hash(files, self.name, type_)
            if built != wanted:
                short = type_.rpartition("/")[2]
                return f"{short} has other fields" if built else f"{short} is not built"
        return ""


def package_name(sources: Sources) -> str:
    """The package's name if it is one of interfaces, which CMake builds; "" for any other."""
    names = [path.removesuffix(f"/{CMAKE_LISTS}") for path in sources if path.endswith(f"/{CMAKE_LISTS}")]
    return next((name for name in names if "/" not in name and f"{name}/setup.py" not in sources), "")


def select_definitions(folder: Path, name: str, sources: Sources) -> None:
    """Copy the definitions that CMakeLists.txt names to where `command` reads them. Raises InvalidFiles."""
    text = _COMMENT.sub("", sources[f"{name}/{CMAKE_LISTS}"].decode("utf-8", "replace"))
    paths = sorted(set(_DEFINITION.findall(text)))
    if not paths:
        raise InvalidFiles(f"{CMAKE_LISTS} names no definition.")
    for path in paths:
        if f"{name}/{path}" not in sources:
            raise InvalidFiles(f"{CMAKE_LISTS} names {path}, but there is no such file.")
        target = folder / "definitions" / name / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(sources[f"{name}/{path}"])
        _require_dependencies(text, _USED.findall(sources[f"{name}/{path}"].decode("utf-8", "replace")), name)


def _require_dependencies(text: str, used: list[str], name: str) -> None:
    """Raise InvalidFiles if CMakeLists.txt does not hand over a package whose types a definition uses."""
    parts = [part.partition("DEPENDENCIES")[2] for part in _HANDED_OVER.findall(text)]
    listed = " ".join(parts).split()
    for other in sorted({*used} - {*listed, name}):
        raise InvalidFiles(f"rosidl_generate_interfaces has no DEPENDENCIES {other}.")


def command(folder: Path) -> list[str]:
    """The command that builds the selected definitions, in the working folder `TOOLS`."""
    return [sys.executable, "-m", "build_tools", str(folder / "definitions"), str(folder / "made")]


def install(folder: Path) -> Path:
    """Arrange what was built as colcon installs it, and return that folder."""
    made, installed = folder / "made", folder / "install"
    shutil.copytree(made / "share", installed / "share")
    shutil.copytree(made / "python", installed / MODULES, ignore=shutil.ignore_patterns("*.c"))
    return installed


def type_hash(files: Mapping[str, bytes], package: str, type_: str) -> str:
    """The type hash of a type among built files, such as "msg/Crate"; "" if it is not there."""
    try:
        hashes = json.loads(files[f"share/{package}/{type_}.json"])["type_hashes"]
        return next(str(row["hash_string"]) for row in hashes if row["type_name"] == f"{package}/{type_}")
    except (KeyError, ValueError, TypeError, StopIteration):
        return ""


def type_names(files: Mapping[str, bytes]) -> list[str]:
    """The full names of the types among built files, such as "crate_interfaces/msg/Crate"."""
    return re.findall(r"^share/(\w+/(?:msg|srv|action)/\w+)\.json$", "\n".join(sorted(files)), re.M)
