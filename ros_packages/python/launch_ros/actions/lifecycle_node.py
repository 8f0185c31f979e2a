"""The action `LifecycleNode`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.utilities import value_of
from lifecycle_msgs.msg import Transition

from launch_ros.actions.lifecycle_transition import LifecycleTransition
from launch_ros.actions.node import Node
from launch_ros.lifecycle_event_manager import LifecycleEventManager


class LifecycleNode(Node):
    """Starts a lifecycle node, and connects its states with the events of the launch file.

    Each transition of the node is a `StateTransition` event, and a `ChangeState` event is a request to it.
    autostart: the node is configured and activated when it starts. The other arguments are those of `Node`.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        autostart: bool | SomeSubstitutionsType = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__autostart = autostart
        self.__event_manager: LifecycleEventManager | None = None

    @property
    def node_autostart(self) -> bool | SomeSubstitutionsType:
        """Return whether the node is configured and activated when it starts."""
        return self.__autostart

    @property
    def is_lifecycle_node(self) -> bool:
        """Work like `Node`."""
        return True

    def get_lifecycle_event_manager(self) -> LifecycleEventManager | None:
        """Return what connects the node with events; None before the action is executed."""
        return self.__event_manager

    def execute(self, context: LaunchContext) -> list[Action] | None:
        """Work like `Action`."""
        self._expand_name(context)
        if self.UNSPECIFIED_NODE_NAME in self.node_name:
            raise RuntimeError("node_name unexpectedly incomplete for lifecycle node")
        self.__event_manager = LifecycleEventManager(self)
        self.__event_manager.setup_lifecycle_manager(context)
        super().execute(context)
        if not value_of(context, self.__autostart, bool):
            return None
        steps = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]
        return [LifecycleTransition(lifecycle_node_names=[self.node_name], transition_ids=steps)]
