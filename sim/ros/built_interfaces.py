"""Loads messages, services and actions that colcon built into the running Python.

A shared library is loaded only once under its name. A newer version of an interface is therefore loaded from
copies whose libraries have other names of the same length.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib
import os
import shutil
import sys
import tempfile
from itertools import count
from pathlib import Path

from sim.ros.messages.cdr import clear_layout_cache
from sim.ros.messages.codec import message_class
from sim.ros.packages import BUILT_HERE, INDEX, install_prefixes

DISPATCHER = "__rosidl_typesupport_c.so"  # builds library names from the package's name

_versions: dict[str, str] = {}  # package -> digest of what was loaded
_numbers = count(2)
_copies: list[tempfile.TemporaryDirectory] = []  # removed when Python exits


def load() -> None:
    """Load the interfaces of all sourced packages in the version that is built now.

    Modules that were imported before keep the old version until they are imported again.
    """
    prefixes = dict(_built())
    versions = {package: _digest(package, prefix) for package, prefix in prefixes.items()}
    known = {package: _versions[package] for package in versions if package in _versions}
    changed = any(versions[package] != version for package, version in known.items())
    _versions.update(versions)
    if changed:
        _load_copies(prefixes)
    else:
        new = [package for package in prefixes if package not in known]
        _load_all([library for package in new for library in _libraries(package, prefixes[package])])


def _built() -> list[tuple[str, Path]]:
    """Package and install prefix of all interfaces that colcon built."""
    return [
        (package, prefix)
        for prefix in install_prefixes()
        if (prefix / BUILT_HERE).is_dir() and (prefix / INDEX / "rosidl_interfaces").is_dir()
        for package in sorted(os.listdir(prefix / INDEX / "rosidl_interfaces"))
    ]


def _libraries(package: str, prefix: Path) -> list[Path]:
    return sorted((prefix / "lib").glob(f"lib{package}__*.so"))


def _modules(package: str, prefix: Path) -> Path:
    return prefix / f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages" / package


def _digest(package: str, prefix: Path) -> str:
    whole = hashlib.sha256()
    for file in (*_libraries(package, prefix), *sorted(_modules(package, prefix).rglob("*.py"))):
        whole.update(file.read_bytes())
    return whole.hexdigest()


def _load_all(libraries: list[Path]) -> None:
    """Load libraries after those they depend on: the linker's search path is fixed at Python's start."""
    while libraries:
        remaining = [library for library in libraries if not _loads(library)]
        if len(remaining) == len(libraries):
            return  # importing them raises an error that names what is missing
        libraries = remaining


def _loads(library: Path) -> bool:
    try:
        ctypes.CDLL(str(library))
    except OSError:
        return False
    return True


def _load_copies(prefixes: dict[str, Path]) -> None:
    """Load all interfaces again: unchanged ones may use those that have changed."""
    mark = f"~{next(_numbers)}"
    names = {package: f"{package[: -len(mark)]}{mark}" for package in prefixes if len(package) > len(mark)}
    _copies.append(tempfile.TemporaryDirectory(prefix="interfaces-"))
    folder = Path(_copies[-1].name)
    libraries = []
    for package, prefix in prefixes.items():
        for library in _libraries(package, prefix):
            name = _renamed(library.name.encode(), names).decode()
            libraries.append(_copy(library, folder / name, package, names))
        shutil.copytree(_modules(package, prefix), folder / "modules" / package)
        for library in (folder / "modules" / package).glob("*.so"):
            _copy(library, library, package, names)
    _load_all(libraries)
    for name in [name for name in sys.modules if name.split(".")[0] in prefixes]:
        del sys.modules[name]
    sys.path.insert(0, str(folder / "modules"))
    importlib.invalidate_caches()
    message_class.cache_clear()
    clear_layout_cache()


def _renamed(content: bytes, names: dict[str, str]) -> bytes:
    for package, name in names.items():
        content = content.replace(f"lib{package}__".encode(), f"lib{name}__".encode())
    return content


def _copy(library: Path, to: Path, package: str, names: dict[str, str]) -> Path:
    content = _renamed(library.read_bytes(), names)
    if library.name.endswith(DISPATCHER) and library.name.startswith("lib"):
        content = content.replace(f"\0{package}\0".encode(), f"\0{names.get(package, package)}\0".encode())
    to.write_bytes(content)
    return to
