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
        if (folder / "install" / LAYOUT).exists() and _is_installed(folder / "install", package):
            return f"it is built, and not sourced: source('{shown}/install/setup.bash') does that."
        if any(name_in(file) == package for file in _descriptions(folder / "src")):
            return f"it is in {shown}/src, and not built: run colcon build in {shown}."
    return ""


def name_in(file: Path) -> str:
    """The package's name in a package.xml, or "" if there is none."""
    try:
        return (ElementTree.parse(file).findtext("name") or "").strip()
    except ElementTree.ParseError:
        return ""


def _workspaces() -> Iterator[Path]:
    here = Path.cwd()
    yield from (here, *sorted(here.iterdir()), *here.parents)


def _is_installed(install: Path, package: str) -> bool:
    prefixes = (install / package, install)
    return any((prefix / INDEX / "packages" / package).is_file() for prefix in prefixes)


def _descriptions(sources: Path) -> Iterator[Path]:
    yield from (*sources.glob("*/package.xml"), *sources.glob("*/*/package.xml"))
