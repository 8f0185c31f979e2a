"""The entities of launch files in YAML and XML, and the actions that are made of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.action import Action
from launch.conditions import IfCondition, UnlessCondition
from launch.located import ERRORS, add_place
from launch.substitution import Substitution
from launch.yaml_frontend.substitutions import parse_substitution
from launch.yaml_frontend.xml_file import XmlText


def _to_bool(type_name: str, key: str, text: str) -> bool:
    if text.lower() not in ("true", "false"):
        raise TypeError(
            f"Attribute '{key}' of Entity '{type_name}' has to be true or false, not {str(text)!r}"
        )
    return text.lower() == "true"


def _to_number(kind: type) -> Callable[[str, str, str], Any]:
    def convert(type_name: str, key: str, text: str) -> Any:
        try:
            return kind(text)
        except ValueError:
            name = "an int" if kind is int else "a float"
            raise TypeError(
                f"Attribute '{key}' of Entity '{type_name}' has to be {name}, not {str(text)!r}"
            ) from None

    return convert


# What an attribute of XML is converted with, where a type is wanted.
CONVERSIONS = {bool: _to_bool, int: _to_number(int), float: _to_number(float)}
COMPONENTS = "loads C++ components, which are not built here: start each node with a node entity."
ELSEWHERE = {  # entities of ROS 1, and of ROS 2 for C++, with what to write
    **dict.fromkeys(("node_container", "load_composable_node", "composable_node"), COMPONENTS),
    "param": "belongs in a node in ROS 2; set_parameter sets one for all nodes of its group.",
    "remap": "belongs in a node in ROS 2; set_remap is for all nodes of its group.",
    "rosparam": 'is of ROS 1: ROS 2 has <param from="FILE"/> in a node.',
    "env": "belongs in a node or an executable; set_env is for all processes of its group.",
    "machine": "is of ROS 1: start a launch file on each machine.",
    "test": "is of ROS 1: launch_pytest tests launch files.",
}
KEYS_OF_ROS1 = {
    ("node", "type"): "exec",
    ("node", "required"): 'on_exit="shutdown"',
    ("node", "machine"): "a launch file on each machine",
    ("group", "ns"): "a push_ros_namespace entity in the group",
    ("node", "ns"): "namespace",
    ("include", "ns"): "a group with a push_ros_namespace entity around it",
    ("arg", "value"): "let for a fixed value, or default for one that can be changed",
    ("arg", "doc"): "description",
    ("param", "command"): "value=\"$(command '...')\"",
}
ACTIONS: dict[str, Callable[[Entity], Action]] = {}


class Entity:
    """An action of a file, or a part of one. Records which keys are read, so that others can be refused."""

    def __init__(self, type_name: str, content: Any) -> None:
        self.type_name, self.content, self.keys_read = type_name, content, set()

    def get(self, key: str, kind: Any = str, optional: bool = False) -> Any:
        """The value of a key; None if an optional key is missing. Raises AttributeError and TypeError."""
        if not isinstance(self.content, dict) or key not in self.content:
            if optional:
                return None
            self._refuse_old_keys()
            raise AttributeError(f"Can not find attribute '{key}' in Entity '{self.type_name}'")
        self.keys_read.add(key)
        found = self.content[key]
        if isinstance(found, XmlText) and kind in CONVERSIONS and "$(" not in found:
            found = CONVERSIONS[kind](self.type_name, key, found)
        if not isinstance(found, kind if kind is not float else (int, float)) and not isinstance(found, str):
            raise TypeError(
                f"Attribute '{key}' of Entity '{self.type_name}' expected to be of type '{kind}', "
                f"got '{type(found)}'"
            )
        return found

    def get_text(self, key: str, optional: bool = True) -> list[Substitution] | None:
        """The value of a key as text with substitutions; None if an optional key is missing."""
        found = self.get(key, object, optional)
        if found is None:
            return None
        return parse_substitution(str(found).lower() if isinstance(found, bool) else str(found))

    def get_entities(self, key: str) -> list[Entity]:
        """The dictionaries in the list at a key."""
        found = self.get(key, list, optional=True) or []
        if not all(isinstance(part, dict) for part in found):
            raise TypeError(
                f"Attribute '{key}' of Entity '{self.type_name}' expected to be a list of dictionaries."
            )
        return [Entity(key, part) for part in found]

    def children(self) -> list[Action]:
        """The actions in it."""
        if isinstance(self.content, dict):
            return [create_action(child) for child in self.get("children", list)]
        return [create_action(child) for child in self.content]

    def check_all_keys_read(self) -> None:
        """Raise ValueError for keys that were not read."""
        left = set(self.content) - self.keys_read if isinstance(self.content, dict) else set()
        if left:
            self._refuse_old_keys()
            raise ValueError(f"Unexpected key(s) found in `{self.type_name}`: {left}")

    def _refuse_old_keys(self) -> None:
        """Raise ValueError for a key that ROS 1 has here."""
        for key in self.content if isinstance(self.content, dict) else ():
            if (self.type_name, key) in KEYS_OF_ROS1:
                wanted = KEYS_OF_ROS1[self.type_name, key]
                raise ValueError(f"`{key}` of `{self.type_name}` is of ROS 1: ROS 2 has {wanted}.")

    def condition(self) -> dict[str, Any]:
        """The argument `condition` of an action, from `if` or `unless`; empty without a condition."""
        if_, unless = self.get_text("if"), self.get_text("unless")
        if if_ is not None and unless is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        if if_ is not None:
            return {"condition": IfCondition(if_)}
        return {} if unless is None else {"condition": UnlessCondition(unless)}


def create_action(child: Any) -> Action:
    """The action of a dictionary with one key, which is the entity's type. Errors say where it is."""
    place = getattr(child, "place", None)
    try:
        action = _create_action(child)
    except ERRORS as error:
        add_place(error, place)
        raise
    action.place = place
    return action


def _create_action(child: Any) -> Action:
    if not isinstance(child, dict) or len(child) != 1:
        raise RuntimeError("Subentities must be a dictionary with only one key, which is the entity type")
    ((type_name, content),) = child.items()
    if type_name not in ACTIONS:
        if type_name in ELSEWHERE:
            raise RuntimeError(f"`{type_name}` {ELSEWHERE[type_name]}")
        known = ", ".join(sorted(ACTIONS))
        raise RuntimeError(f"Unrecognized entity of the type: {type_name}. There are {known}.")
    entity = Entity(type_name, {} if content is None else content)
    action = ACTIONS[type_name](entity)
    entity.check_all_keys_read()
    return action


def expose_action(*type_names: str) -> Callable[[Callable[[Entity], Action]], Callable[[Entity], Action]]:
    """Register a function that makes an action of entities of these types."""

    def register(make: Callable[[Entity], Action]) -> Callable[[Entity], Action]:
        ACTIONS.update(dict.fromkeys(type_names, make))
        return make

    return register
