"""The substitution `Command`."""

from __future__ import annotations

import shlex
import subprocess

from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import (
    describe_substitutions,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class Command(Substitution):
    """The output of a command on stdout. on_stderr: "fail", "ignore", "warn" or "capture"."""

    def __init__(self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail") -> None:
        self.__command = normalize_to_list_of_substitutions(command)
        self.__on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @property
    def command(self) -> list[Substitution]:
        """The command."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """Return what happens if the command writes to stderr."""
        return self.__on_stderr

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"Command({describe_substitutions(self.command)})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
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
            captured = f"\nCaptured stderr output: {done.stderr}" if done.stderr else ""
            raise SubstitutionFailure(f"executed command failed. Command: {command}{captured}")
        if done.stderr and on_stderr in ("fail", "warn"):
            text = "executed command showed stderr output."
            text += f" Command: {command}\nCaptured stderr output:\n{done.stderr}"
            if on_stderr == "fail":
                raise SubstitutionFailure(text)
            get_logger().warning(text)
        return done.stdout
