"""Sources a colcon workspace in the running Python, as `source install/setup.bash` does in a terminal."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
from pathlib import Path

from sim.ros import built_interfaces

SHELL_VARIABLES = ("_", "OLDPWD", "PWD", "SHLVL")
PYTHONPATH = "PYTHONPATH"


def source(script: str | Path) -> None:
    """Make the packages of a workspace available in this Python, its programs and later cells.

    script: a file written by colcon, such as "ws/install/setup.bash". As in a terminal, a new package needs
    another `source`; a rebuilt program doesn't.
    Raises FileNotFoundError if there is no such file, RuntimeError if bash can't source it.
    """
    path = Path(script).resolve()
    if not path.is_file():
        raise FileNotFoundError(f"There is no {script}: colcon build in the workspace creates it.")
    changed = _changed_variables(path)
    before = os.environ.get(PYTHONPATH, "").split(os.pathsep)
    os.environ.update(changed)
    for folder in reversed(os.environ.get(PYTHONPATH, "").split(os.pathsep)):
        if folder and folder not in before and folder not in sys.path:
            sys.path.insert(0, folder)
    importlib.invalidate_caches()
    built_interfaces.load()


def _changed_variables(script: Path) -> dict[str, str]:
    """The environment variables that differ in bash after it has sourced the script."""
    done = subprocess.run(
        ["bash", "-c", 'source "$0" >&2 && env -0', str(script)], capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(f"bash can't source {script}: {done.stderr.strip()}")
    pairs = (line.split("=", 1) for line in done.stdout.split("\0") if "=" in line)
    return {
        name: value for name, value in pairs if name not in SHELL_VARIABLES and os.environ.get(name) != value
    }
