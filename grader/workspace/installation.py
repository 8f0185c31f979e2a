"""Installs a built package for the programs of a run, and prepares its programs and launch files.

The confined process of a student can't start a shell to source a setup file, so the two paths that it would
set are set here.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from grader.workspace.building import Built
from grader.workspace.sources import InvalidFiles, read_files
from sim.ros.remote import trust_types_in

PREFIXES = "AMENT_PREFIX_PATH"
LAYOUT = ".colcon_install_layout"

TYPE_SUPPORT = "_s__rosidl_typesupport_c.so"

_prefixes: list[Path] = []  # the current install prefix; at most one
_type_packages: set[str] = set()  # installed now or before, and still imported


def install(files: Mapping[str, bytes], programs: Iterable[str]) -> None:
    """Install files for this process, with priority over other packages; replaces a previous installation."""
    uninstall()
    _forget(_type_packages)
    _type_packages.clear()
    _type_packages.update(path.split("/")[-2] for path in files if path.endswith(TYPE_SUPPORT))
    prefix = Path(tempfile.mkdtemp(prefix="install-"))
    _prefixes.append(prefix)
    for path, data in files.items():
        file = prefix / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
        file.chmod(0o755 if path in set(programs) else 0o644)
    (prefix / LAYOUT).write_text("merged\n")
    os.environ[PREFIXES] = os.pathsep.join(filter(None, [str(prefix), os.environ.get(PREFIXES, "")]))
    sys.path.insert(0, str(_modules(prefix)))


def uninstall() -> None:
    """Remove the installed files and modules.

    Types of messages stay imported until the next installation: recordings of a run are decoded with them.
    """
    while _prefixes:
        prefix = _prefixes.pop()
        known = os.environ.get(PREFIXES, "").split(os.pathsep)
        os.environ[PREFIXES] = os.pathsep.join(word for word in known if word != str(prefix))
        sys.path[:] = [word for word in sys.path if not word.startswith(str(prefix))]
        modules = list(sys.modules.items())
        own = {
            name for name, module in modules if str(getattr(module, "__file__", None)).startswith(str(prefix))
        }
        _forget({name.split(".")[0] for name in own} - _type_packages)
        shutil.rmtree(prefix, ignore_errors=True)


def _forget(packages: Iterable[str]) -> None:
    """Let the modules of these packages be imported anew."""
    for name in [name for name in sys.modules if name.split(".")[0] in packages]:
        del sys.modules[name]


def _modules(prefix: Path) -> Path:
    return prefix / f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"


def ros2_run(_: Any, package: str, name: str, *arguments: str) -> Any:
    """A `prepare` for scenarios: the program that `ros2 run package name` starts, with arguments."""
    from sim import Process, executable

    return Process(_deferred(lambda: executable(package, name), name), arguments=list(arguments))


def _deferred(find: Callable[[], Callable[[], None]], name: str) -> Callable[[], None]:
    """A program that is looked up when it starts, so that a missing one is an error of the program."""

    def main() -> None:
        find()()

    main.__name__ = main.__qualname__ = name
    return main


def ros2_launch(_: Any, package: str, file: str, *arguments: str) -> str:
    """A `prepare` for scenarios: the command line of `ros2 launch package file`, with arguments."""
    return " ".join([package, file, *arguments])


def typed_in_terminals(workspace: Any, package: str) -> Any:
    """A `prepare` for scenarios: what session.txt of the package says, typed in terminals."""
    from sim.ros2.typed_session import terminals

    file = Path(os.fspath(workspace), "src", package, "session.txt")
    text = file.read_text("utf-8", "replace") if file.is_file() else ""
    return terminals(text, _prefixes[-1])


def read_sources(workspace: Any, package: str) -> dict[str, bytes]:
    """The sources of one package of a workspace. Raises InvalidFiles."""
    found = read_files(Path(os.fspath(workspace)) / "src" / package, f"ws/src/{package}")
    return {f"{package}/{path}": data for path, data in found.items()}


def serialize_sources(nodes: Sequence[Any], package: str) -> dict[str, bytes] | str | None:
    """The response of the student's process: the sources, or an error text; None without a workspace."""
    try:
        [workspace] = nodes
        if workspace is None:
            return None
        return read_sources(workspace, package)
    except InvalidFiles as reason:
        return str(reason)
    except Exception:
        return "Give the folder of the workspace, in quotes."


def install_remotely(_: Sequence[Any], files: dict[str, bytes], programs: list[str]) -> None:
    """Called in the student's process: install these files, and use types of messages that are among them."""
    install(files, programs)
    trust_types_in(str(_modules(_prefixes[-1])))


def serialize_installation(built: Built) -> tuple[dict[str, bytes], list[str]]:
    """The arguments of `install_remotely`."""
    return dict(built.files), sorted(built.programs)
