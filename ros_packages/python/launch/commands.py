"""Texts that commands give, and where commands are."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys

from launch.entities import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.utilities import described, normalize_to_list_of_substitutions, perform_substitutions


class Command(Substitution):
    """What a command writes to stdout. on_stderr: "fail", "ignore", "warn" or "capture"."""

    def __init__(self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail") -> None:
        self.__command = normalize_to_list_of_substitutions(command)
        self.__on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @property
    def command(self) -> list[Substitution]:
        """The command."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """What is done about words on stderr."""
        return self.__on_stderr

    def describe(self) -> str:
        """As `Substitution`."""
        return f"Command({described(self.command)})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        command = perform_substitutions(context, self.command)
        on_stderr = perform_substitutions(context, self.on_stderr)
        if on_stderr not in ("fail", "ignore", "warn", "capture"):
            raise SubstitutionFailure(
                "expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'"
            )
        stderr = subprocess.STDOUT if on_stderr == "capture" else subprocess.PIPE
        try:
            done = subprocess.run(
                shlex.split(command), stdout=subprocess.PIPE, stderr=stderr, text=True, check=False
            )
        except FileNotFoundError as error:
            raise SubstitutionFailure(f"file not found: {error}") from None
        if done.returncode:
            heard = f"\nCaptured stderr output: {done.stderr}" if done.stderr else ""
            raise SubstitutionFailure(f"executed command failed. Command: {command}{heard}")
        if done.stderr and on_stderr in ("fail", "warn"):
            text = "executed command showed stderr output."
            text += f" Command: {command}\nCaptured stderr output:\n{done.stderr}"
            if on_stderr == "fail":
                raise SubstitutionFailure(text)
            get_logger().warning(text)
        return done.stdout


class FindExecutable(Substitution):
    """Where a command is, as a shell would find it; and this Python's own where no shell was told of it."""

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Its name."""
        return self.__name

    def describe(self) -> str:
        """As `Substitution`."""
        return f"FindExec({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        name = perform_substitutions(context, self.name)
        found = shutil.which(name) or shutil.which(name, path=f"{sys.prefix}/bin")
        if found is None:
            raise SubstitutionFailure(f"executable '{name}' not found on the PATH")
        return found
