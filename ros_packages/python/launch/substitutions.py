"""Texts that are known only when a launch file runs."""

from __future__ import annotations

import importlib
import math
import os
from collections.abc import Iterable
from typing import Any, NoReturn

from launch.commands import Command, FindExecutable
from launch.comparing import EqualsSubstitution, NotEqualsSubstitution
from launch.entities import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.launch_context import LaunchContext
from launch.unsupported import refuse
from launch.utilities import (
    described,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

__all__ = [
    "Command",
    "EnvironmentVariable",
    "EqualsSubstitution",
    "FindExecutable",
    "LaunchConfiguration",
    "LocalSubstitution",
    "NotEqualsSubstitution",
    "PathJoinSubstitution",
    "PythonExpression",
    "SubstitutionFailure",
    "TextSubstitution",
    "ThisLaunchFileDir",
]


class TextSubstitution(Substitution):
    """A text as it is."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self.__text = text

    @property
    def text(self) -> str:
        """The text."""
        return self.__text

    def describe(self) -> str:
        """As `Substitution`."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        return self.text


class LaunchConfiguration(Substitution):
    """The value of a launch configuration, such as a launch argument."""

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any = None) -> None:
        self.__name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None
        if default is not None:
            parts = default if isinstance(default, Iterable) and not isinstance(default, str) else [default]
            texts = [part if isinstance(part, str | Substitution) else str(part) for part in parts]
            self.__default = normalize_to_list_of_substitutions(texts)

    @property
    def variable_name(self) -> list[Substitution]:
        """The name of the configuration."""
        return self.__name

    def describe(self) -> str:
        """As `Substitution`."""
        return f"LaunchConfig({described(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        name = perform_substitutions(context, self.__name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.__default is None:
            raise SubstitutionFailure(f"launch configuration '{name}' does not exist")
        return perform_substitutions(context, self.__default)


class EnvironmentVariable(Substitution):
    """The value of an environment variable."""

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default = None if default_value is None else normalize_to_list_of_substitutions(default_value)

    @property
    def name(self) -> list[Substitution]:
        """The name of the variable."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """What stands in where there is no such variable."""
        return self.__default

    def describe(self) -> str:
        """As `Substitution`."""
        return f"EnvVar({described(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        name = perform_substitutions(context, self.__name)
        if name in context.environment:
            return context.environment[name]
        if self.__default is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return perform_substitutions(context, self.__default)


class PathJoinSubstitution(Substitution):
    """The parts of a path, joined."""

    def __init__(self, substitutions: Iterable[str | Substitution]) -> None:
        self.__substitutions = normalize_to_list_of_substitutions(substitutions)

    @property
    def substitutions(self) -> list[Substitution]:
        """The parts."""
        return self.__substitutions

    def describe(self) -> str:
        """As `Substitution`."""
        return f"PathJoin('{described(self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        return os.path.join(*(sub.perform(context) for sub in self.__substitutions))


class PythonExpression(Substitution):
    """What Python makes of an expression; the names of `math` are known in it."""

    def __init__(
        self, expression: SomeSubstitutionsType, python_modules: SomeSubstitutionsType = ("math",)
    ) -> None:
        for value, name in ((expression, "expression"), (python_modules, "python_modules")):
            ensure_argument_type(value, (str, Substitution, Iterable), name, "PythonExpression")
        self.__expression = normalize_to_list_of_substitutions(expression)
        self.__modules = normalize_to_list_of_substitutions(python_modules)

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self.__expression

    @property
    def python_modules(self) -> list[Substitution]:
        """The names of the modules that it knows."""
        return self.__modules

    def describe(self) -> str:
        """As `Substitution`."""
        modules = ", ".join(sub.describe() for sub in self.python_modules)
        return f"PythonExpr({described(self.expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        known = {name: importlib.import_module(name) for name in (m.perform(context) for m in self.__modules)}
        if "math" in known:
            known = {**vars(math), **known}
        return str(eval(perform_substitutions(context, self.__expression), {}, known))


class LocalSubstitution(Substitution):
    """What is known in an event handler, such as "event.reason"."""

    def __init__(self, expression: str) -> None:
        ensure_argument_type(expression, str, "expression", "LocalSubstitution")
        self.__expression = expression

    @property
    def expression(self) -> str:
        """The expression."""
        return self.__expression

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        return eval(f"known.{self.expression}", {}, {"known": context.locals})


class ThisLaunchFileDir(Substitution):
    """The folder of the launch file in which it stands."""

    def describe(self) -> str:
        """As `Substitution`."""
        return "ThisLaunchFileDir()"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        known = context.get_locals_as_dict()
        if "current_launch_file_directory" not in known:
            raise SubstitutionFailure("ThisLaunchFileDir used outside of a launch file (in a script)")
        return known["current_launch_file_directory"]


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
