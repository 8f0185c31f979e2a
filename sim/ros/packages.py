"""Programs of packages that colcon built: which file `ros2 run` starts, and why there is none."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from xml.etree import ElementTree

from sim.ros import brought
from sim.suggestions import closest_match

INDEX = "share/ament_index/resource_index"
BUILT_HERE = "share/colcon-core/packages"  # in a prefix that colcon filled
LAYOUT = ".colcon_install_layout"  # in install/


class PackageNotFound(LookupError):
    """No package of that name is known; the words say what was left out."""


class ExecutableNotFound(LookupError):
    """The package has no program of that name; the words say what was left out."""


def executable(package: str, name: str) -> Callable[[], None]:
    """The program that `ros2 run package name` starts, as a main() function for `run`, `play` and `Process`.

    Each start reads the package's files anew, as a process of its own does: the newest build is what runs.
    Raises PackageNotFound or ExecutableNotFound, with the likely reason.
    """
    own = None if _is_installed_program(package, name) else brought.module(package, name)
    file = path_of(package, name) if own is None else None

    def main() -> None:
        if own is not None:
            status = importlib.import_module(own).main()
            if status:
                raise SystemExit(status)
            return
        forget_modules()
        _start(file)

    main.__name__ = main.__qualname__ = name
    return main


def path_of(package: str, name: str) -> Path:
    """The file of a package's program. Raises as `executable`."""
    _check_brought(package, name)
    prefix = prefix_of(package)
    programs = executables(package)
    file = prefix / "lib" / package / name
    if name in programs and b"python" in _first_line(file):
        return file
    raise ExecutableNotFound(f"No executable found: {_why_no_program(prefix, package, name, programs)}")


def command_of(package: str, name: str) -> list[str]:
    """What `ros2 run package name` starts. Raises as `executable`."""
    own = brought_command(package, name)
    if own is not None:
        return own
    if not _is_installed_program(package, name):
        path_of(package, name)  # says why
    return [str(prefix_of(package) / "lib" / package / name)]


def brought_command(package: str, name: str) -> list[str] | None:
    """What starts a program that the course brings and nobody has installed; None for any other.

    Raises ExecutableNotFound for what such a package lacks.
    """
    if _is_installed_program(package, name):
        return None
    _check_brought(package, name)
    return brought.command(package, name)


def _check_brought(package: str, name: str) -> None:
    """Raise ExecutableNotFound for a program that a package of ROS's own has elsewhere, and not here."""
    if _is_installed_program(package, name):
        return
    instead = brought.instead(package, name)
    if instead is None and package in brought.PROGRAMS and name not in (known := executables(package)):
        instead = _no_such(package, name, known)
    if instead is not None:
        raise ExecutableNotFound(f"No executable found: {instead}")


def executables(package: str) -> list[str]:
    """The names of a package's programs, sorted. Raises PackageNotFound."""
    own = brought.PROGRAMS.get(package, {})
    folder = None if own and not _is_known(package) else prefix_of(package) / "lib" / package
    files = folder.iterdir() if folder is not None and folder.is_dir() else ()
    return sorted({file.name for file in files if file.is_file() and os.access(file, os.X_OK)} | own.keys())


def _is_known(package: str) -> bool:
    return any((prefix / INDEX / "packages" / package).is_file() for prefix in _prefixes())


def _is_installed_program(package: str, name: str) -> bool:
    files = (prefix / "lib" / package / name for prefix in _prefixes())
    return _is_known(package) and any(file.is_file() and os.access(file, os.X_OK) for file in files)


def prefix_of(package: str) -> Path:
    """The folder that a package was installed into. Raises PackageNotFound."""
    for prefix in _prefixes():
        if package and (prefix / INDEX / "packages" / package).is_file():
            return prefix
    raise PackageNotFound(f"Package '{package}' not found: {_why_no_package(package)}")


def packages() -> list[str]:
    """The names of all packages that are known, sorted."""
    folders = [prefix / INDEX / "packages" for prefix in _prefixes()]
    return sorted({file.name for folder in folders if folder.is_dir() for file in folder.iterdir()})


def forget_modules() -> None:
    """Let packages that colcon built be imported anew.

    Interfaces stay: what one program sends and another hears must be one type.
    """
    importlib.invalidate_caches()
    places = tuple(f"{place}{os.sep}" for place in _built_places())
    own = {name for name, module in list(sys.modules.items()) if _lies_in(module, places)}
    interfaces = {name for prefix in _prefixes() for name in _listed(prefix / INDEX / "rosidl_interfaces")}
    for name in own:
        if name.split(".")[0] not in interfaces:
            del sys.modules[name]


def _start(file: Path) -> None:
    """Do what Python does with a program; `sys.modules["__main__"]` stays the notebook's."""
    code = compile(file.read_bytes(), str(file), "exec")
    folder = str(file.resolve().parent)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    exec(code, {"__name__": "__main__", "__file__": str(file)})


def _prefixes() -> list[Path]:
    return [Path(word) for word in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if word]


def _listed(folder: Path) -> list[str]:
    return os.listdir(folder) if folder.is_dir() else []


def _built_places() -> Iterator[Path]:
    """install/ and build/ of each workspace: with --symlink-install, modules are imported from the latter."""
    for prefix in _prefixes():
        if (prefix / BUILT_HERE).is_dir():
            install = prefix if (prefix / LAYOUT).exists() else prefix.parent
            yield from (install, install.parent / "build")


def _lies_in(module: object, places: tuple[str, ...]) -> bool:
    file = getattr(module, "__file__", None)
    return isinstance(file, str) and file.startswith(places)


def _first_line(file: Path) -> bytes:
    with file.open("rb") as opened:
        return opened.readline(256) if opened.read(2) == b"#!" else b""


def _why_no_package(package: str) -> str:
    for folder in (Path.cwd(), *sorted(Path.cwd().iterdir()), *Path.cwd().parents):
        if (folder / "install" / LAYOUT).exists() and _is_installed(folder / "install", package):
            return f"it is built, and not sourced. Say source('{_shown(folder)}/install/setup.bash')."
        if any(_name_in(file) == package for file in _descriptions(folder / "src")):
            return f"it is in {_shown(folder)}/src, and not built. Say colcon build in {_shown(folder)}."
    near = closest_match(package, packages())
    if near:
        return f"did you mean {near}?"
    return "no package.xml has that name in a workspace here, and no workspace that has it was sourced."


def _is_installed(install: Path, package: str) -> bool:
    places = (install / package, install)
    return any((place / INDEX / "packages" / package).is_file() for place in places)


def _descriptions(sources: Path) -> Iterator[Path]:
    yield from (*sources.glob("*/package.xml"), *sources.glob("*/*/package.xml"))


def _name_in(file: Path) -> str:
    try:
        return (ElementTree.parse(file).findtext("name") or "").strip()
    except ElementTree.ParseError:
        return ""


def _shown(folder: Path) -> str:
    return os.path.relpath(folder)


def _why_no_program(prefix: Path, package: str, name: str, programs: list[str]) -> str:
    if name in programs:
        return f"{name} of {package} is no Python program. A run takes those alone; ros2 run starts it."
    if (prefix / "bin" / name).is_file():
        return (
            f"{name} was installed into bin, and not into lib/{package}. "
            f"In setup.cfg, [install] must say install_scripts=$base/lib/{package}."
        )
    if not programs:
        return f"{package} has none. Name one in 'console_scripts' of its setup.py, and build it again."
    return (
        f"{_no_such(package, name, programs)} What is new in 'console_scripts' of "
        "setup.py is there after the next colcon build."
    )


def _no_such(package: str, name: str, programs: list[str]) -> str:
    near = closest_match(name, programs)
    guess = f" Did you mean {near}?" if near else ""
    return f"{package} has {', '.join(programs)}, and no {name}.{guess}"
