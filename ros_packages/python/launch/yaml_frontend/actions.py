"""The actions of launch in launch files in YAML."""

from __future__ import annotations

import re
import shlex
from typing import Any

from launch import actions
from launch.action import Action
from launch.substitution import Substitution
from launch.yaml_frontend.entity import Entity, expose_action
from launch.yaml_frontend.substitutions import parse_substitution


@expose_action("arg")
def _arg(entity: Entity) -> Action:
    choices = [choice.get("value") for choice in entity.get_entities("choice")]
    return actions.DeclareLaunchArgument(
        entity.get("name"),
        default_value=entity.get_text("default"),
        description=entity.get("description", optional=True),
        choices=choices or None,
        **entity.condition(),
    )


@expose_action("let")
def _let(entity: Entity) -> Action:
    name, value = entity.get_text("name", optional=False), entity.get_text("value", optional=False)
    return actions.SetLaunchConfiguration(name, value, **entity.condition())


@expose_action("set_env")
def _set_env(entity: Entity) -> Action:
    name, value = entity.get_text("name", optional=False), entity.get_text("value", optional=False)
    return actions.SetEnvironmentVariable(name, value, **entity.condition())


@expose_action("log")
def _log(entity: Entity) -> Action:
    return actions.LogInfo(msg=entity.get_text("message", optional=False), **entity.condition())


@expose_action("shutdown")
def _shutdown(entity: Entity) -> Action:
    return actions.Shutdown(
        reason=entity.get("reason", optional=True) or "reason not given", **entity.condition()
    )


@expose_action("group")
def _group(entity: Entity) -> Action:
    scoped, forwarding = (entity.get(key, bool, optional=True) for key in ("scoped", "forwarding"))
    kept = {
        tuple(keep.get_text("name", False)): keep.get_text("value", False)
        for keep in entity.get_entities("keep")
    }
    return actions.GroupAction(
        entity.children(),
        scoped=scoped is not False,
        forwarding=forwarding is not False,
        launch_configurations=kept,
        **entity.condition(),
    )


@expose_action("include")
def _include(entity: Entity) -> Action:
    arguments = [
        (arg.get_text("name", False), arg.get_text("value", False)) for arg in entity.get_entities("arg")
    ]
    return actions.IncludeLaunchDescription(
        entity.get_text("file", optional=False), launch_arguments=arguments, **entity.condition()
    )


@expose_action("timer")
def _timer(entity: Entity) -> Action:
    return actions.TimerAction(
        period=entity.get_text("period", optional=False), actions=entity.children(), **entity.condition()
    )


@expose_action("executable")
def _executable(entity: Entity) -> Action:
    cmd = parse_command(entity, "cmd", optional=False)
    return actions.ExecuteProcess(cmd=cmd, name=entity.get_text("name"), **process_options(entity))


def parse_command(entity: Entity, key: str, optional: bool = True) -> list[list[Substitution]]:
    """The words of a command at a key, each with its substitutions."""
    text = entity.get(key, str, optional)
    lexer = shlex.shlex(re.sub(r"\$\([^()]*\)", _hide_spaces, text or ""), posix=True, punctuation_chars="")
    lexer.whitespace_split, lexer.commenters = True, ""
    return [parse_substitution(word.replace("\0", " ")) for word in lexer]


def _hide_spaces(match: re.Match) -> str:
    return match[0].replace(" ", "\0")


def process_options(entity: Entity) -> dict[str, Any]:
    """The optional arguments that `ExecuteProcess` and `Node` have in common."""
    on_exit = entity.get("on_exit", optional=True)
    if on_exit not in (None, "shutdown"):
        raise ValueError(
            f"Attribute on_exit of Entity node expected to be shutdown but got `{on_exit}`"
            "Other on_exit actions not yet supported"
        )
    delay = entity.get("respawn_delay", float, optional=True)
    if delay is not None and float(delay) < 0:
        raise ValueError(
            "Attribute respawn_delay of Entity node expected to be a non-negative value but got "
            f"`{float(delay)}`"
        )
    found = {
        "cwd": entity.get_text("cwd"),
        "prefix": entity.get_text("launch-prefix"),
        "output": entity.get_text("output"),
        "respawn": entity.get_text("respawn"),
        "respawn_delay": None if delay is None else float(delay),
        "respawn_max_retries": entity.get("respawn_max_retries", int, optional=True),
        "shell": entity.get("shell", bool, optional=True),
        "on_exit": None if on_exit is None else [actions.Shutdown()],
        "additional_env": {
            tuple(env.get_text("name", False)): env.get_text("value", False)
            for env in entity.get_entities("env")
        },
    }
    return {key: value for key, value in found.items() if value is not None} | entity.condition()
