"""ros2 run: runs a program of a package."""

from __future__ import annotations

import argparse
import contextlib
import shlex
import signal
import subprocess
from argparse import Namespace

from sim.ros.packages import ExecutableNotFound, PackageNotFound, command_of, executables, packages
from sim.ros2.environment import environment_before, require_terminal
from sim.ros2.group import Group, argument
from sim.ros2.system import CliError, Output

run = Group("run", "Run a package specific executable")


def _programs(options: Namespace) -> list[str]:
    """The programs of the package in the options; none if there is no such package."""
    try:
        return executables(options.package_name)
    except PackageNotFound:
        return []


@run.verb(
    "",
    argument("--prefix", help="Prefix command, which should go before the executable."),
    argument("package_name", help="Name of the ROS package", completer=lambda *_: packages()),
    argument(
        "executable_name", help="Name of the executable", completer=lambda _, options: _programs(options)
    ),
    argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable"),
    without_system=True,
)
def run_(output: Output, options: Namespace) -> None:
    """Run a package specific executable."""
    package, name = options.package_name, options.executable_name
    require_terminal("run", f'run(executable("{package}", "{name}"))')
    try:
        command = command_of(package, name)
    except (PackageNotFound, ExecutableNotFound) as error:
        raise CliError(str(error)) from None
    words = [*shlex.split(options.prefix or ""), *command, *options.argv]
    try:
        process = subprocess.Popen(words, env=environment_before())
    except OSError as error:
        raise CliError(f"{words[0]} can't be started: {error.strerror}. Check its first line.") from None
    while process.returncode is None:
        with contextlib.suppress(KeyboardInterrupt):  # the program gets SIGINT, too
            process.wait()
    status = process.returncode
    if status < 0:
        output.print_line(f"[ros2run]: {signal.strsignal(-status)}")
    elif status:
        output.print_line(f"[ros2run]: Process exited with failure {status}")
    raise SystemExit(status)
