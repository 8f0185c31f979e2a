"""What `source install/setup.bash` does for a terminal, done for the Python that runs."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
from pathlib import Path

from sim.ros import built_interfaces

SHELLS_OWN = ("_", "OLDPWD", "PWD", "SHLVL")
PATHS = "PYTHONPATH"


def source(script: str | Path) -> None:
    """Let this Python, its programs and its further cells know the packages of a workspace.

    script: what colcon wrote, such as "ws/install/setup.bash". As in a terminal, it is said again for a
    package that is new; a program that was built anew is found without.
    Raises FileNotFoundError where there is no such file, RuntimeError where bash can't read it.
    """
    path = Path(script).resolve()
    if not path.is_file():
        raise FileNotFoundError(f"There is no {script}: colcon build, said in the workspace, writes it.")
    changed = _said_by(path)
    before = os.environ.get(PATHS, "").split(os.pathsep)
    os.environ.update(changed)
    for place in reversed(os.environ.get(PATHS, "").split(os.pathsep)):
        if place and place not in before and place not in sys.path:
            sys.path.insert(0, place)
    importlib.invalidate_caches()
    built_interfaces.load()


def _said_by(script: Path) -> dict[str, str]:
    """The variables that bash has otherwise after it read the script."""
    done = subprocess.run(
        ["bash", "-c", 'source "$0" >&2 && env -0', str(script)], capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(f"bash can't source {script}: {done.stderr.strip()}")
    pairs = (word.split("=", 1) for word in done.stdout.split("\0") if "=" in word)
    return {name: value for name, value in pairs if name not in SHELLS_OWN and os.environ.get(name) != value}
