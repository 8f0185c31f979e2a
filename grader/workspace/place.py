"""Where a built package is installed for the programs of a run, and which program is meant.

In a student's process that is marked nothing can be started, so no shell can source anything: the two paths
that it would set are set here.
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
from grader.workspace.sources import Refused, read_files

PREFIXES = "AMENT_PREFIX_PATH"
LAYOUT = ".colcon_install_layout"

_here: list[Path] = []  # where packages are installed now: at most one


def install(files: Mapping[str, bytes], programs: Iterable[str]) -> None:
    """Let this process find what was installed, before all else, and forget what came before."""
    leave()
    prefix = Path(tempfile.mkdtemp(prefix="install-"))
    _here.append(prefix)
    for path, data in files.items():
        file = prefix / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
        file.chmod(0o755 if path in set(programs) else 0o644)
    (prefix / LAYOUT).write_text("merged\n")
    os.environ[PREFIXES] = os.pathsep.join(filter(None, [str(prefix), os.environ.get(PREFIXES, "")]))
    sys.path.insert(0, str(_modules(prefix)))


def leave() -> None:
    """Forget what was installed."""
    while _here:
        prefix = _here.pop()
        known = os.environ.get(PREFIXES, "").split(os.pathsep)
        os.environ[PREFIXES] = os.pathsep.join(word for word in known if word != str(prefix))
        sys.path[:] = [word for word in sys.path if not word.startswith(str(prefix))]
        for name, module in list(sys.modules.items()):
            if str(getattr(module, "__file__", None)).startswith(str(prefix)):
                del sys.modules[name]
        shutil.rmtree(prefix, ignore_errors=True)


def _modules(prefix: Path) -> Path:
    return prefix / f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"


def program(_: Any, package: str, name: str, *words: str) -> Any:
    """In place of the workspace: what `ros2 run package name` starts, with further words."""
    from sim import Process, executable

    return Process(_started(lambda: executable(package, name), name), arguments=list(words))


def _started(find: Callable[[], Callable[[], None]], name: str) -> Callable[[], None]:
    """A program that is looked for when it starts: that there is none is the program's own error."""

    def main() -> None:
        find()()

    main.__name__ = main.__qualname__ = name
    return main


def launched(_: Any, package: str, file: str, *words: str) -> str:
    """In place of the workspace: what `ros2 launch package file` does, with arguments."""
    return " ".join([package, file, *words])


def read_sources(workspace: Any, package: str) -> dict[str, bytes]:
    """The sources of one package of a workspace. Raises Refused."""
    found = read_files(Path(os.fspath(workspace)) / "src" / package, f"ws/src/{package}")
    return {f"{package}/{path}": data for path, data in found.items()}


def told_sources(nodes: Sequence[Any], package: str) -> dict[str, bytes] | str | None:
    """What the student's process answers: its sources, or why not; None for no workspace."""
    try:
        [workspace] = nodes
        if workspace is None:
            return None
        return read_sources(workspace, package)
    except Refused as reason:
        return str(reason)
    except Exception:
        return "Give the folder of the workspace, in quotes."


def installed(_: Sequence[Any], files: dict[str, bytes], programs: list[str]) -> None:
    """What the student's process is told to install."""
    install(files, programs)


def told(built: Built) -> tuple[dict[str, bytes], list[str]]:
    """What `installed` takes."""
    return dict(built.files), sorted(built.programs)
