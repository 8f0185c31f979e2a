"""What a program is started with: its words, its name, its folder and its environment."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterable
from typing import Any

from launch.entities import SomeSubstitutionsType
from launch.launch_context import LaunchContext
from launch.substitutions import LaunchConfiguration
from launch.utilities import text_of

Texts = dict[SomeSubstitutionsType, SomeSubstitutionsType]


def prepared(
    context: LaunchContext,
    words: Iterable[SomeSubstitutionsType],
    prefix: SomeSubstitutionsType | None,
    name: SomeSubstitutionsType | None,
    cwd: SomeSubstitutionsType | None,
    env: Texts | None,
    additional_env: Texts | None,
) -> dict[str, Any]:
    """All of it, by the names that the events of a process have for it."""
    cmd, wanted = [text_of(context, word) for word in words], True
    if prefix is None:
        prefix = LaunchConfiguration("launch-prefix", default="")
        only = LaunchConfiguration("launch-prefix-filter", default="").perform(context)
        wanted = re.match(only, os.path.basename(cmd[0])) is not None
    if wanted:
        cmd = [*shlex.split(text_of(context, prefix)), *cmd]
    called = os.path.basename(cmd[0]) if name is None else text_of(context, name)
    given = dict(context.environment) if env is None else _texts(context, env)
    return {
        "name": f"{called}-{next(context.numbers)}",
        "cmd": cmd,
        "cwd": None if cwd is None else text_of(context, cwd),
        "env": given | _texts(context, additional_env or {}),
    }


def _texts(context: LaunchContext, some: Texts) -> dict[str, str]:
    return {text_of(context, name): text_of(context, value) for name, value in some.items()}
