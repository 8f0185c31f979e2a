"""Finds packages and their programs: the file that `ros2 run` starts, or the reason why there is none."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from sim.absent_packages import explain_package
from sim.ros import workspaces
from sim.ros.bundled_programs import PROGRAMS, alternative, command, module_in_a_run
from sim.ros.workspaces import INDEX, LAYOUT
from sim.suggestions import closest_match

WHEEL_SCRIPT = b"python\n"  # after #!: setuptools writes it for `scripts=`, and no kernel finds that program
BUILT_HERE = "share/colcon-core/packages"  # in an install prefix that colcon has written


class PackageNotFound(LookupError):
    """There is no package of that name; the message says why."""


class ExecutableNotFound(LookupError):
    """The package has no program of that name; the message says why."""


def executable(package: str, name: str) -> Callable[[], None]:
    """The program that `ros2 run package name` starts, as a main() function for `run`, `play` and `Process`.

    Each start reads the package's files again, as a new process does, so that the newest build runs.
    Raises PackageNotFound or ExecutableNotFound, with the likely reason.
    """
    bundled = None if _is_installed_program(package, name) else module_in_a_run(package, name)
    file = path_of(package, name) if bundled is None else None

    def main() -> None:
        if bundled is not None:
            status = importlib.import_module(bundled).main()
            if status:
                raise SystemExit(status)
            return
        forget_modules()
        _start(file)

    main.__name__ = main.__qualname__ = name
    main.bundled = bundled is not None  # type: ignore[attr-defined]
    return main


def path_of(package: str, name: str) -> Path:
    """The file of a package's program. Raises as `executable`."""
    _check_bundled(package, name)
    prefix = prefix_of(package)
    programs = executables(package)
    file = prefix / "lib" / package / name
    if name in programs and b"python" in _first_line(file):
        return file
    raise ExecutableNotFound(f"No executable found: {_why_no_program(prefix, package, name, programs)}")


def command_of(package: str, name: str) -> list[str]:
    """Return what `ros2 run package name` starts. Raises as `executable`."""
    bundled = bundled_command(package, name)
    if bundled is not None:
        return bundled
    if not _is_installed_program(package, name):
        path_of(package, name)  # raises with the reason
    return [str(prefix_of(package) / "lib" / package / name)]


def bundled_command(package: str, name: str) -> list[str] | None:
    """The command for a program that is not installed, or that the system can't start; None for any other.

    The former are those that the course includes. Raises ExecutableNotFound for those that it does not.
    """
    if _is_installed_program(package, name):
        file = prefix_of(package) / "lib" / package / name
        return [sys.executable, str(file)] if _first_line(file) == WHEEL_SCRIPT else None
    _check_bundled(package, name)
    return command(package, name)


def _check_bundled(package: str, name: str) -> None:
    """Raise ExecutableNotFound for a program that a bundled package has in ROS, but not here."""
    if _is_installed_program(package, name):
        return
    reason = alternative(package, name)
    if reason is None and package in PROGRAMS and name not in (known := executables(package)):
        reason = _no_such(package, name, known)
    if reason is not None:
        raise ExecutableNotFound(f"No executable found: {reason}")


def executables(package: str) -> list[str]:
    """The names of a package's programs, sorted. Raises PackageNotFound."""
    bundled = PROGRAMS.get(package, {})
    folder = None if bundled and not _is_known(package) else prefix_of(package) / "lib" / package
    files = folder.iterdir() if folder is not None and folder.is_dir() else ()
    installed = {file.name for file in files if file.is_file() and os.access(file, os.X_OK)}
    return sorted(installed | bundled.keys())


def _is_known(package: str) -> bool:
    return any((prefix / INDEX / "packages" / package).is_file() for prefix in install_prefixes())


def _is_installed_program(package: str, name: str) -> bool:
    files = (prefix / "lib" / package / name for prefix in install_prefixes())
    return _is_known(package) and any(file.is_file() and os.access(file, os.X_OK) for file in files)


def prefix_of(package: str) -> Path:
    """The install prefix of a package. Raises PackageNotFound."""
    for prefix in install_prefixes():
        if package and (prefix / INDEX / "packages" / package).is_file():
            return prefix
    raise PackageNotFound(f"Package '{package}' not found: {why_no_package(package)}")


def packages() -> list[str]:
    """The names of all packages, sorted."""
    folders = [prefix / INDEX / "packages" for prefix in install_prefixes()]
    return sorted({file.name for folder in folders if folder.is_dir() for file in folder.iterdir()})


def forget_modules() -> None:
    """Let the modules of packages that colcon built be imported again.

    Interfaces stay imported: a publisher and its subscribers must use the same type.
    """
    importlib.invalidate_caches()
    folders = tuple(f"{folder}{os.sep}" for folder in _built_folders())
    built = {name for name, module in list(sys.modules.items()) if _is_in(module, folders)}
    interfaces = {
        name for prefix in install_prefixes() for name in _listed(prefix / INDEX / "rosidl_interfaces")
    }
    for name in built:
        if name.split(".")[0] not in interfaces:
            del sys.modules[name]


def _start(file: Path) -> None:
    """Run a file as a program; `sys.modules["__main__"]` stays the notebook's."""
    code = compile(file.read_bytes(), str(file), "exec")
    folder = str(file.resolve().parent)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    exec(code, {"__name__": "__main__", "__file__": str(file)})


def install_prefixes() -> list[Path]:
    """The install prefixes in AMENT_PREFIX_PATH."""
    return [Path(path) for path in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if path]


def _listed(folder: Path) -> list[str]:
    return os.listdir(folder) if folder.is_dir() else []


def _built_folders() -> Iterator[Path]:
    """install/ and build/ of each workspace; with --symlink-install, modules are imported from build/."""
    for prefix in install_prefixes():
        if (prefix / BUILT_HERE).is_dir():
            install = prefix if (prefix / LAYOUT).exists() else prefix.parent
            yield from (install, install.parent / "build")


def _is_in(module: object, folders: tuple[str, ...]) -> bool:
    file = getattr(module, "__file__", None)
    return isinstance(file, str) and file.startswith(folders)


def _first_line(file: Path) -> bytes:
    with file.open("rb") as opened:
        return opened.readline(256) if opened.read(2) == b"#!" else b""


def why_no_package(package: str) -> str:
    """Return why a package is not found: not sourced, known and not here, misspelt, or nowhere."""
    reason = workspaces.why_unavailable(package) or explain_package(package)
    if reason:
        return reason
    near = closest_match(package, packages())
    if near:
        return f"did you mean {near}?"
    return "no package.xml has that name in a workspace here, and no workspace that has it was sourced."


def _why_no_program(prefix: Path, package: str, name: str, programs: list[str]) -> str:
    if name in programs:
        return f"{name} of {package} is not a Python program. A run starts only those; ros2 run starts it."
    if (prefix / "bin" / name).is_file():
        return (
            f"{name} was installed into bin, not into lib/{package}. In setup.cfg, [install] must set "
            f"install_scripts=$base/lib/{package}."
        )
    if (prefix / "lib" / package / name).is_file():
        return (
            f"{name} of {package} is not executable. Run chmod +x on its source, or install it with "
            "install(PROGRAMS ...) in CMakeLists.txt, and build it again."
        )
    if (prefix / "share" / package / "cmake").is_dir():
        where, how = "CMakeLists.txt", f"Install one with install(PROGRAMS ... DESTINATION lib/{package})"
        how += " in its CMakeLists.txt"
    else:
        where, how = "'console_scripts' of setup.py", "Name one in 'console_scripts' of its setup.py"
    if not programs:
        return f"{package} has none. {how}, and build it again."
    return f"{_no_such(package, name, programs)} Changes in {where} take effect after the next colcon build."


def _no_such(package: str, name: str, programs: list[str]) -> str:
    near = closest_match(name, programs)
    guess = f" Did you mean {near}?" if near else ""
    return f"{package} has {', '.join(programs)}, but no {name}.{guess}"
