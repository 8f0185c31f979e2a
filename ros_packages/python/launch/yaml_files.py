"""Launch files in YAML: each action by its word, with upstream's keys and substitutions, as $(var NAME)."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml

from launch import actions
from launch.conditions import IfCondition, UnlessCondition
from launch.entities import Action, Substitution
from launch.launch_description import LaunchDescription
from launch.yaml_texts import parse_substitution

ACTIONS: dict[str, Callable[[Entity], Action]] = {}


class Entity:
    """One action of a file, or a part of one. Each key is asked for; what is left at the end is refused."""

    def __init__(self, word: str, content: Any) -> None:
        self.word, self.content, self.read = word, content, set()

    def value(self, key: str, kind: Any = str, optional: bool = False) -> Any:
        """What stands at a key; None where nothing does. Raises AttributeError and TypeError."""
        if not isinstance(self.content, dict) or key not in self.content:
            if optional:
                return None
            raise AttributeError(f"Can not find attribute '{key}' in Entity '{self.word}'")
        self.read.add(key)
        found = self.content[key]
        if not isinstance(found, kind if kind is not float else (int, float)) and not isinstance(found, str):
            raise TypeError(
                f"Attribute '{key}' of Entity '{self.word}' expected to be of type '{kind}', "
                f"got '{type(found)}'"
            )
        return found

    def text(self, key: str, optional: bool = True) -> list[Substitution] | None:
        """A text with its substitutions; None where there is none."""
        found = self.value(key, object, optional)
        return None if found is None else parse_substitution(_as_text(found))

    def inner(self, key: str) -> list[Entity]:
        """The dictionaries at a key."""
        found = self.value(key, list, optional=True) or []
        if not all(isinstance(part, dict) for part in found):
            raise TypeError(
                f"Attribute '{key}' of Entity '{self.word}' expected to be a list of dictionaries."
            )
        return [Entity(key, part) for part in found]

    def children(self) -> list[Action]:
        """The actions in it."""
        if isinstance(self.content, dict):
            return [made(child) for child in self.value("children", list)]
        return [made(child) for child in self.content]

    def check(self) -> None:
        """Raise ValueError for keys that nobody has asked for."""
        left = set(self.content) - self.read if isinstance(self.content, dict) else set()
        if left:
            raise ValueError(f"Unexpected key(s) found in `{self.word}`: {left}")

    def options(self) -> dict[str, Any]:
        """What every action may have: if, or unless."""
        if_, unless = self.text("if"), self.text("unless")
        if if_ is not None and unless is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        if if_ is not None:
            return {"condition": IfCondition(if_)}
        return {} if unless is None else {"condition": UnlessCondition(unless)}


def described(path: str) -> LaunchDescription:
    """What a file describes. Raises RuntimeError, and what is said of wrong keys and values."""
    from launch_ros import yaml_nodes  # noqa: F401  (it adds the words for nodes, and needs this module)

    tree = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    if not isinstance(tree, dict) or list(tree) != ["launch"] or not isinstance(tree["launch"], list):
        raise RuntimeError(f"{path} is no launch file: it has to begin with `launch:`, and a list below it.")
    return LaunchDescription([made(child) for child in tree["launch"]])


def made(child: Any) -> Action:
    """The action that a dictionary of one word stands for."""
    if not isinstance(child, dict) or len(child) != 1:
        raise RuntimeError("Subentities must be a dictionary with only one key, which is the entity type")
    ((word, content),) = child.items()
    if word not in ACTIONS:
        known = ", ".join(sorted(ACTIONS))
        raise RuntimeError(f"Unrecognized entity of the type: {word}. There are {known}.")
    entity = Entity(word, {} if content is None else content)
    action = ACTIONS[word](entity)
    entity.check()
    return action


def word_for(*words: str) -> Callable[[Callable[[Entity], Action]], Callable[[Entity], Action]]:
    """Add the action that a word stands for."""

    def add(make: Callable[[Entity], Action]) -> Callable[[Entity], Action]:
        ACTIONS.update(dict.fromkeys(words, make))
        return make

    return add


def _as_text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


# -- actions -----------------------------------------------------------------------------------------


@word_for("arg")
def _arg(entity: Entity) -> Action:
    choices = [choice.value("value") for choice in entity.inner("choice")]
    return actions.DeclareLaunchArgument(
        entity.value("name"),
        default_value=entity.text("default"),
        description=entity.value("description", optional=True),
        choices=choices or None,
        **entity.options(),
    )


@word_for("let")
def _let(entity: Entity) -> Action:
    name, value = entity.text("name", optional=False), entity.text("value", optional=False)
    return actions.SetLaunchConfiguration(name, value, **entity.options())


@word_for("set_env")
def _set_env(entity: Entity) -> Action:
    name, value = entity.text("name", optional=False), entity.text("value", optional=False)
    return actions.SetEnvironmentVariable(name, value, **entity.options())


@word_for("log")
def _log(entity: Entity) -> Action:
    return actions.LogInfo(msg=entity.text("message", optional=False), **entity.options())


@word_for("shutdown")
def _shutdown(entity: Entity) -> Action:
    return actions.Shutdown(
        reason=entity.value("reason", optional=True) or "reason not given", **entity.options()
    )


@word_for("group")
def _group(entity: Entity) -> Action:
    scoped, forwarding = (entity.value(key, bool, optional=True) for key in ("scoped", "forwarding"))
    kept = {tuple(keep.text("name", False)): keep.text("value", False) for keep in entity.inner("keep")}
    return actions.GroupAction(
        entity.children(),
        scoped=scoped is not False,
        forwarding=forwarding is not False,
        launch_configurations=kept,
        **entity.options(),
    )


@word_for("include")
def _include(entity: Entity) -> Action:
    given = [(arg.text("name", False), arg.text("value", False)) for arg in entity.inner("arg")]
    return actions.IncludeLaunchDescription(
        entity.text("file", optional=False), launch_arguments=given, **entity.options()
    )


@word_for("timer")
def _timer(entity: Entity) -> Action:
    return actions.TimerAction(
        period=entity.text("period", optional=False), actions=entity.children(), **entity.options()
    )


@word_for("executable")
def _executable(entity: Entity) -> Action:
    return actions.ExecuteProcess(
        cmd=words(entity, "cmd", optional=False), name=entity.text("name"), **process_options(entity)
    )


def words(entity: Entity, key: str, optional: bool = True) -> list[list[Substitution]]:
    """The words of a command, each with its substitutions."""
    text = entity.value(key, str, optional)
    lexer = shlex.shlex(
        re.sub(r"\$\([^()]*\)", _without_spaces, text or ""), posix=True, punctuation_chars=""
    )
    lexer.whitespace_split, lexer.commenters = True, ""
    return [parse_substitution(word.replace("\0", " ")) for word in lexer]


def _without_spaces(match: re.Match) -> str:
    return match[0].replace(" ", "\0")


def process_options(entity: Entity) -> dict[str, Any]:
    """What a program may have besides its words."""
    on_exit = entity.value("on_exit", optional=True)
    if on_exit not in (None, "shutdown"):
        raise ValueError(
            f"Attribute on_exit of Entity node expected to be shutdown but got `{on_exit}`"
            "Other on_exit actions not yet supported"
        )
    delay = entity.value("respawn_delay", float, optional=True)
    if delay is not None and float(delay) < 0:
        raise ValueError(
            "Attribute respawn_delay of Entity node expected to be a non-negative value but got "
            f"`{float(delay)}`"
        )
    found = {
        "cwd": entity.text("cwd"),
        "prefix": entity.text("launch-prefix"),
        "output": entity.text("output"),
        "respawn": entity.text("respawn"),
        "respawn_delay": None if delay is None else float(delay),
        "respawn_max_retries": entity.value("respawn_max_retries", int, optional=True),
        "shell": entity.value("shell", bool, optional=True),
        "on_exit": None if on_exit is None else [actions.Shutdown()],
        "additional_env": {
            tuple(env.text("name", False)): env.text("value", False) for env in entity.inner("env")
        },
    }
    return {key: value for key, value in found.items() if value is not None} | entity.options()
