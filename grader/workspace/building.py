"""Builds a package with colcon from its sources alone, as a fresh clone on another machine would be built."""

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

from grader.workspace.sources import INSTALLED, InvalidFiles, Sources, read_files, validate_files

SECONDS = 300.0  # only against hanging: a busy machine is slow, and the sandbox limits the CPU time
OUTPUT_BYTES = 50_000  # limit of colcon's output; its end is kept
COLCON = (
    *("--log-base", "/dev/null", "build", "--merge-install", "--executor", "sequential"),
    *("--event-handlers", "console_stderr+", "console_direct-"),
)
NOT_TAKEN = "What was installed can't be taken."
TOO_LONG = f"colcon build did not end within {SECONDS:g} s."


class CannotBuildHere(Exception):
    """This process can't start programs, so it can't run colcon."""


@dataclass(frozen=True)
class Built:
    """The result of a build.

    files: the installed files, by path below install/. programs: the executable ones. output: the end of
    colcon's output, in full lines. problem: why the build failed, or "".
    """

    files: Mapping[str, bytes] = field(default_factory=dict)
    programs: frozenset[str] = frozenset()
    output: str = ""
    problem: str = ""


Build = Callable[[Sources], Built]


def build(sources: Sources) -> Built:
    """Build in a temporary folder. Raises CannotBuildHere."""
    with tempfile.TemporaryDirectory(prefix="ws-", ignore_cleanup_errors=True) as folder:
        return build_in(Path(folder), sources)


def build_in(folder: Path, sources: Sources) -> Built:
    """Build in this folder. Raises CannotBuildHere."""
    for path, data in sources.items():
        file = folder / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    status, output = _colcon(folder)
    if status is None:
        return Built(output=output, problem=TOO_LONG)
    if status or "Finished <<<" not in output:
        return Built(output=output, problem="colcon build failed.")
    install = folder / "install"
    try:
        files = read_files(install, "install", INSTALLED)
    except InvalidFiles as reason:
        return Built(output=output, problem=f"{NOT_TAKEN} {reason}")
    programs = frozenset(path for path in files if os.access(install / path, os.X_OK))
    return Built(files, programs, output)


def parse_built(files: Any, programs: Any, output: Any, problem: Any) -> Built:
    """The result of a build in another process, validated. Raises InvalidFiles."""
    taken = validate_files(files, "install", INSTALLED)
    listed = programs if isinstance(programs, list) else []
    names = [name for name in listed if isinstance(name, str)]
    texts = [text if isinstance(text, str) else "" for text in (output, problem)]
    output, problem = (text[-OUTPUT_BYTES:].encode(errors="replace").decode() for text in texts)
    return Built(taken, frozenset(name for name in names if name in taken), output, problem)


def _colcon(folder: Path) -> tuple[int | None, str]:
    """Colcon's exit status, None after a timeout, and the end of its output."""
    inherited = ("PATH", "HOME", "TMPDIR", "LANG", "PYTHONHASHSEED")
    environment = {name: os.environ[name] for name in inherited if name in os.environ}
    environment |= {"PYTHONDONTWRITEBYTECODE": "1", "PYTHONWARNINGS": "ignore", "COLCON_HOME": str(folder)}
    command = [sys.executable, str(Path(sys.executable).with_name("colcon")), *COLCON]
    with tempfile.TemporaryFile() as output:
        try:
            process = subprocess.Popen(
                command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip
        except PermissionError:
            raise CannotBuildHere from None
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
    output.seek(max(0, size - OUTPUT_BYTES))
    return output.read().decode(errors="replace")
