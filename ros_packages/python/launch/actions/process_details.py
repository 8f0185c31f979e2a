"""What a process is started with: its command, name, working directory and environment."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterable
from typing import Any

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.substitutions import LaunchConfiguration
from launch.utilities import text_of

EnvironmentVariables = dict[SomeSubstitutionsType, SomeSubstitutionsType]


def expand_process_details(
    context: LaunchContext,
    cmd: Iterable[SomeSubstitutionsType],
    prefix: SomeSubstitutionsType | None,
    name: SomeSubstitutionsType | None,
    cwd: SomeSubstitutionsType | None,
    env: EnvironmentVariables | None,
    additional_env: EnvironmentVariables | None,
) -> dict[str, Any]:
    """The details of a process with all substitutions performed, under the names that its events use."""
    words, use_prefix = [text_of(context, word) for word in cmd], True
    if prefix is None:
        prefix = LaunchConfiguration("launch-prefix", default="")
        pattern = LaunchConfiguration("launch-prefix-filter", default="").perform(context)
        use_prefix = re.match(pattern, os.path.basename(words[0])) is not None
    if use_prefix:
        words = [*shlex.split(text_of(context, prefix)), *words]
    base_name = os.path.basename(words[0]) if name is None else text_of(context, name)
    environment = dict(context.environment) if env is None else _expand(context, env)
    return {
        "name": f"{base_name}-{next(context.process_numbers)}",
        "cmd": words,
        "cwd": None if cwd is None else text_of(context, cwd),
        "env": environment | _expand(context, additional_env or {}),
    }


def _expand(context: LaunchContext, variables: EnvironmentVariables) -> dict[str, str]:
    return {text_of(context, name): text_of(context, value) for name, value in variables.items()}
