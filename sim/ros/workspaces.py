"""Workspaces near the current folder: why a package in one of them can't be found."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

INDEX = "share/ament_index/resource_index"
LAYOUT = ".colcon_install_layout"  # in install/


def why_unavailable(package: str) -> str:
    """Return why a package in a workspace here was not found, and what to do; "" for any other."""
    for folder in _workspaces():
        shown = _shown(folder)
        at, into = ("here", "") if shown == "." else (f"in {shown}", f"{shown}/")
        descriptions = {file: read_name(file) for file in _descriptions(folder / "src")}
        for file, (name, error) in descriptions.items():
            reason = (error or why_invalid(file)) if package in (name, file.parent.name) else ""
            if reason:  # colcon builds it as plain Python
                return f"{_shown(file)} is not valid: {reason}. Correct it, and build again."
        prefix = _prefix_of(folder / "install", package)
        if (folder / "install" / LAYOUT).exists() and prefix is not None:
            if str(prefix) in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
                return ""  # it is sourced
            script = f"{into}install/setup.bash"
            both = f"`source {script}` in a terminal, `source('{script}')` in a notebook"
            return f"it is built but not sourced: {both}."
        if any(name == package for name, _ in descriptions.values()):
            return f"it is in {into}src but not built: run colcon build {at}."
    return ""


def sources_of(package: str) -> dict[str, bytes]:
    """A package's Python files and CMakeLists.txt in a workspace here, as "PACKAGE/setup.py" and so on."""
    for folder in _workspaces():
        for description in _descriptions(folder / "src"):
            if read_name(description)[0] == package:
                top = description.parent
                files = (*top.rglob("*.py"), *top.glob("CMakeLists.txt"))
                return {f"{package}/{file.relative_to(top).as_posix()}": file.read_bytes() for file in files}
    return {}


def read_name(file: Path) -> tuple[str, str]:
    """The package's name in a package.xml, and why it can't be read, or ""."""
    try:
        return (ElementTree.parse(file).findtext("name") or "").strip(), ""
    except ElementTree.ParseError as error:
        name = re.search(r"<name>\s*(\w+)\s*</name>", file.read_text(encoding="utf-8", errors="replace"))
        return name[1] if name else "", str(error)


def why_invalid(file: Path) -> str:
    """Return what colcon does not accept in a package.xml, or ""."""
    try:
        from catkin_pkg.package import InvalidPackage, parse_package  # slow, and colcon's
    except ImportError:
        return ""
    try:
        kind = parse_package(file, warnings=[]).get_build_type()
    except (AssertionError, InvalidPackage) as error:
        return str(error).splitlines()[-1].removeprefix("- ").rstrip(".")
    known = kind in ("ament_python", "ament_cmake", "cmake")
    return "" if known else "its <export> needs the build_type ament_python or ament_cmake"


def _workspaces() -> Iterator[Path]:
    here = Path.cwd()
    yield from (here, *sorted(here.iterdir()), *here.parents)


def _shown(path: Path) -> str:
    """A path as seen from the current folder, or whole if it is outside."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative


def _prefix_of(install: Path, package: str) -> Path | None:
    prefixes = (install / package, install)
    return next((prefix for prefix in prefixes if (prefix / INDEX / "packages" / package).is_file()), None)


def _descriptions(sources: Path) -> Iterator[Path]:
    yield from (*sources.glob("*/package.xml"), *sources.glob("*/*/package.xml"))
