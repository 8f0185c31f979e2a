"""The action `PushROSNamespace`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, text_of

from launch_ros.namespaces import NAMESPACE, join_namespaces, validate_namespace


class PushROSNamespace(Action):
    """Puts all later nodes of its group into this namespace, inside those that were pushed before."""

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @property
    def namespace(self) -> list[Any]:
        """The namespace."""
        return self.__namespace

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        pushed, before = text_of(context, self.__namespace), context.launch_configurations.get(NAMESPACE)
        namespace = join_namespaces(before, pushed)
        try:
            validate_namespace(namespace)
        except Exception:
            raise SubstitutionFailure(
                f"The resulting namespace is invalid: [previous_namespace='{before}', "
                f"pushed_namespace='{pushed}']"
            ) from None
        context.launch_configurations[NAMESPACE] = namespace


PushRosNamespace = PushROSNamespace
