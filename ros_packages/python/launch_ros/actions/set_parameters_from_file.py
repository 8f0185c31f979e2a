"""The action `SetParametersFromFile`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

from launch_ros.parameters import GLOBAL_PARAMETERS


class SetParametersFromFile(Action):
    """Gives the parameters in a YAML file to all later nodes of its group."""

    def __init__(self, filename: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__file = normalize_to_list_of_substitutions(filename)

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        parameters = context.launch_configurations.setdefault(GLOBAL_PARAMETERS, [])
        parameters.append(perform_substitutions(context, self.__file))
