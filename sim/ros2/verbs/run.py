"""ros2 run: one program of a package."""

from __future__ import annotations

import argparse
import contextlib
import shlex
import signal
import subprocess
from argparse import Namespace

from sim.ros.packages import ExecutableNotFound, PackageNotFound, command_of, executables, packages
from sim.ros2.group import Group, argument
from sim.ros2.surroundings import environment_before, need_terminal
from sim.ros2.system import Voice, Wrong

run = Group("run", "Run a package specific executable")


def _programs(asked: Namespace) -> list[str]:
    """The programs of the package that was named; none where there is no such package."""
    try:
        return executables(asked.package_name)
    except PackageNotFound:
        return []


@run.verb(
    "",
    argument("--prefix", help="Prefix command, which should go before the executable."),
    argument("package_name", help="Name of the ROS package", offers=lambda *_: packages()),
    argument("executable_name", help="Name of the executable", offers=lambda _, asked: _programs(asked)),
    argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable"),
    alone=True,
)
def run_(voice: Voice, asked: Namespace) -> None:
    """Run a package specific executable."""
    package, name = asked.package_name, asked.executable_name
    need_terminal("run", f'run(executable("{package}", "{name}"))')
    try:
        command = command_of(package, name)
    except (PackageNotFound, ExecutableNotFound) as error:
        raise Wrong(str(error)) from None
    process = subprocess.Popen(
        [*shlex.split(asked.prefix or ""), *command, *asked.argv], env=environment_before()
    )
    while process.returncode is None:
        with contextlib.suppress(KeyboardInterrupt):  # the terminal has told the program, too
            process.wait()
    status = process.returncode
    if status < 0:
        voice.say(f"[ros2run]: {signal.strsignal(-status)}")
    elif status:
        voice.say(f"[ros2run]: Process exited with failure {status}")
    raise SystemExit(status)
