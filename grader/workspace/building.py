"""Builds a package from its sources alone, as a fresh clone on another machine would be built.

colcon builds a package of programs. One of interfaces is built in seconds without CMake, see `interfaces`.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from grader.workspace import interfaces
from grader.workspace.sources import INSTALLED, InvalidFiles, Sources, read_files, validate_files
from sim.ros2.absent_colcon import SENTENCE

SECONDS = 300.0  # only against hanging: a busy machine is slow, and the sandbox limits the CPU time
OUTPUT_BYTES = 50_000  # limit of colcon's output; what is between its begin and its end is left out
CUT = "\n[The rest of the output is left out]\n"
HALF = (OUTPUT_BYTES - len(CUT)) // 2
COLCON = (
    *("--log-base", "/dev/null", "build", "--merge-install", "--executor", "sequential"),
    *("--event-handlers", "console_stderr+", "console_direct-"),
)
NOT_TAKEN = "The installed files can't be used."
TOO_LONG = f"colcon build did not end within {SECONDS:g} s."


class CannotBuildHere(Exception):
    """This process can't start programs, so it can't run colcon."""


@dataclass(frozen=True)
class Built:
    """The result of a build.

    files: the installed files, by path below install/. programs: the executable ones. output: what colcon
    printed; if it was too long, its begin and its end. problem: why the build failed, or "".
    """

    files: Mapping[str, bytes] = field(default_factory=dict)
    programs: frozenset[str] = frozenset()
    output: str = ""
    problem: str = ""

    def with_files_of(self, other: Built) -> Built:
        """Return this build with the files of another one installed beside its own."""
        return replace(self, files={**other.files, **self.files})


Build = Callable[[Sources], Built]


def build(sources: Sources) -> Built:
    """Build in a temporary folder. Raises CannotBuildHere."""
    with tempfile.TemporaryDirectory(prefix="ws-", ignore_cleanup_errors=True) as folder:
        return build_in(Path(folder), sources)


def build_in(folder: Path, sources: Sources) -> Built:
    """Build in this folder. Raises CannotBuildHere."""
    folder = folder.absolute()
    for path, data in sources.items():
        file = folder / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    name = interfaces.package_name(sources)
    return _build_interfaces(folder, name, sources) if name else _build_programs(folder)


def _build_programs(folder: Path) -> Built:
    colcon = Path(sys.executable).with_name("colcon")
    if not colcon.exists():
        return Built(problem=SENTENCE)
    command = [sys.executable, str(colcon), *COLCON]
    status, output = _execute(command, folder, folder)
    if status is None:
        return Built(output=output, problem=TOO_LONG)
    if status or "Finished <<<" not in output:
        return Built(output=output, problem="colcon build failed.")
    return _installed(folder / "install", output)


def _build_interfaces(folder: Path, name: str, sources: Sources) -> Built:
    try:
        interfaces.select_definitions(folder, name, sources)
    except InvalidFiles as reason:
        return Built(problem=str(reason))
    status, output = _execute(interfaces.command(folder), interfaces.TOOLS, folder)
    if status is None:
        return Built(output=output, problem=TOO_LONG)
    if status:
        return Built(output=output, problem=interfaces.FAILED)
    return _installed(interfaces.install(folder), output)


def _installed(install: Path, output: str) -> Built:
    """The result of a build that has ended well: what it installed in this folder."""
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
    output, problem = (_shortened(text).encode(errors="replace").decode() for text in texts)
    return Built(taken, frozenset(name for name in names if name in taken), output, problem)


def _execute(command: Sequence[str], working: Path, folder: Path) -> tuple[int | None, str]:
    """Run a command of a build in a working folder. folder: the workspace.

    Returns its exit status, None after a timeout, and its output, shortened.
    """
    inherited = ("PATH", "HOME", "TMPDIR", "LANG", "PYTHONHASHSEED")
    environment = {name: os.environ[name] for name in inherited if name in os.environ}
    environment |= {"PYTHONDONTWRITEBYTECODE": "1", "COLCON_HOME": str(folder)}
    with tempfile.TemporaryFile() as output:
        try:
            process = subprocess.Popen(
                command, cwd=working, env=environment, stdin=subprocess.DEVNULL, stdout=output,
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
        return status, _begin_and_end(output)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End it and what it left running in its session."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _begin_and_end(output: Any) -> str:
    """Return what a file has, and of a long one the begin and the end."""
    size = output.seek(0, os.SEEK_END)
    output.seek(0)
    begin: str = output.read(HALF).decode(errors="replace")
    output.seek(max(min(HALF, size), size - HALF))
    end: str = output.read().decode(errors="replace")
    return f"{begin}{CUT if size > 2 * HALF else ''}{end}"


def _shortened(text: str) -> str:
    return text if len(text) <= OUTPUT_BYTES else text[:HALF] + CUT + text[-HALF:]
