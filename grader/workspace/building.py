"""Builds a package with colcon, from its sources alone: what a fresh copy on another machine would give."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from grader.workspace.sources import INSTALLED, Refused, Sources, checked, read_files

SECONDS = 300.0  # only against hanging: a busy machine is slow, and the sandbox counts what is computed
SAID = 50_000  # bytes of what colcon says last
COLCON = (
    *("--log-base", "/dev/null", "build", "--merge-install", "--executor", "sequential"),
    *("--event-handlers", "console_stderr+", "console_direct-"),
)
NOT_TAKEN = "What was installed can't be taken."
TOO_LONG = f"colcon build did not end within {SECONDS:g} s."


class NotHere(Exception):
    """No program can be started in this process: something else builds for it."""


@dataclass(frozen=True)
class Built:
    """What became of a build.

    files: what was installed, by path below install/. programs: those of them that can be executed. said: the
    last that colcon said, in full lines. problem: why there is nothing to run, or "".
    """

    files: Mapping[str, bytes] = field(default_factory=dict)
    programs: frozenset[str] = frozenset()
    said: str = ""
    problem: str = ""


Build = Callable[[Sources], Built]


def build(sources: Sources) -> Built:
    """Build in a folder that is gone afterwards. Raises NotHere where no program can be started."""
    with tempfile.TemporaryDirectory(prefix="ws-", ignore_cleanup_errors=True) as folder:
        return build_in(Path(folder), sources)


def build_in(folder: Path, sources: Sources) -> Built:
    """Build in this folder. Raises NotHere where no program can be started."""
    for path, data in sources.items():
        file = folder / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    status, said = _colcon(folder)
    if status is None:
        return Built(said=said, problem=TOO_LONG)
    if status or "Finished <<<" not in said:
        return Built(said=said, problem="colcon build failed.")
    install = folder / "install"
    try:
        files = read_files(install, "install", INSTALLED)
    except Refused as reason:
        return Built(said=said, problem=f"{NOT_TAKEN} {reason}")
    programs = frozenset(path for path in files if os.access(install / path, os.X_OK))
    return Built(files, programs, said)


def checked_built(files: Any, programs: Any, said: Any, problem: Any) -> Built:
    """The same for what another process says. Raises Refused."""
    taken = checked(files, "install", INSTALLED)
    listed = programs if isinstance(programs, list) else []
    names = [name for name in listed if isinstance(name, str)]
    words = [word if isinstance(word, str) else "" for word in (said, problem)]
    said, problem = (word[-SAID:].encode(errors="replace").decode() for word in words)
    return Built(taken, frozenset(name for name in names if name in taken), said, problem)


def _colcon(folder: Path) -> tuple[int | None, str]:
    """Its exit status, None if it did not end in time, and the last that it said."""
    kept = ("PATH", "HOME", "TMPDIR", "LANG", "PYTHONHASHSEED")
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    environment |= {"PYTHONDONTWRITEBYTECODE": "1", "PYTHONWARNINGS": "ignore", "COLCON_HOME": str(folder)}
    command = [sys.executable, str(Path(sys.executable).with_name("colcon")), *COLCON]
    with tempfile.TemporaryFile() as output:
        try:
            process = subprocess.Popen(
                command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip
        except PermissionError:
            raise NotHere from None
        try:
            status = process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            _end(process)
        return status, _last(output)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End it and what it left running in its session."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _last(output: Any) -> str:
    size = output.seek(0, os.SEEK_END)
    output.seek(max(0, size - SAID))
    return output.read().decode(errors="replace")
