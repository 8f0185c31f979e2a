"""The action `SetParameter`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.utilities import text_of

from launch_ros.parameters import GLOBAL_PARAMETERS, evaluate_parameter


class SetParameter(Action):
    """Sets this parameter of all later nodes of its group."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name, self.__value = name, value

    @property
    def name(self) -> Any:
        """Its name."""
        return self.__name

    @property
    def value(self) -> Any:
        """Its value."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        name = text_of(context, self.__name)
        parameters = context.launch_configurations.setdefault(GLOBAL_PARAMETERS, [])
        parameters.append((name, evaluate_parameter(context, name, self.__value)))
