"""Workspaces near the current folder: why a package in one of them can't be found."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

INDEX = "share/ament_index/resource_index"
LAYOUT = ".colcon_install_layout"  # in install/


def why_unavailable(package: str) -> str:
    """Why a package in a workspace here was not found, and what to do; "" for any other."""
    for folder in _workspaces():
        shown = os.path.relpath(folder)
        at, into = ("here", "") if shown == "." else (f"in {shown}", f"{shown}/")
        descriptions = {file: read_name(file) for file in _descriptions(folder / "src")}
        for file, (_, error) in descriptions.items():
            reason = (error or why_invalid(file)) if file.parent.name == package else ""
            if reason:  # colcon builds it as plain Python
                return f"{os.path.relpath(file)} is not valid: {reason}. Correct it, and build again."
        if (folder / "install" / LAYOUT).exists() and _is_installed(folder / "install", package):
            script = f"{into}install/setup.bash"
            both = f"`source {script}` in a terminal, `source('{script}')` in a notebook"
            return f"it is built but not sourced: {both}."
        if any(name == package for name, _ in descriptions.values()):
            return f"it is in {into}src but not built: run colcon build {at}."
    return ""


def read_name(file: Path) -> tuple[str, str]:
    """The package's name in a package.xml, and why it can't be read; one of them is ""."""
    try:
        return (ElementTree.parse(file).findtext("name") or "").strip(), ""
    except ElementTree.ParseError as error:
        return "", str(error)


def why_invalid(file: Path) -> str:
    """What colcon does not accept in a package.xml, or ""."""
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


def _is_installed(install: Path, package: str) -> bool:
    prefixes = (install / package, install)
    return any((prefix / INDEX / "packages" / package).is_file() for prefix in prefixes)


def _descriptions(sources: Path) -> Iterator[Path]:
    yield from (*sources.glob("*/package.xml"), *sources.glob("*/*/package.xml"))
