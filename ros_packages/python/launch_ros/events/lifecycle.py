"""The events of lifecycle nodes: a transition that was made, and one that is requested."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, ClassVar

from launch.event import Event
from lifecycle_msgs.msg import State, Transition, TransitionEvent

from launch_ros.events import matchers

__all__ = ["ChangeState", "StateTransition", "matches_node_name"]


class ChangeState(Event):
    """A transition is requested of lifecycle nodes: those whose action `lifecycle_node_matcher` accepts.

    transition_id: a constant of lifecycle_msgs/msg/Transition. Raises ValueError for another number.
    """

    name = "launch_ros.events.lifecycle.ChangeState"
    valid_transitions: ClassVar = {
        getattr(Transition, name): name
        for name in (
            "TRANSITION_CREATE",
            "TRANSITION_CONFIGURE",
            "TRANSITION_CLEANUP",
            "TRANSITION_ACTIVATE",
            "TRANSITION_DEACTIVATE",
            "TRANSITION_UNCONFIGURED_SHUTDOWN",
            "TRANSITION_INACTIVE_SHUTDOWN",
            "TRANSITION_ACTIVE_SHUTDOWN",
            "TRANSITION_DESTROY",
        )
    }
    valid_states: ClassVar = {
        getattr(State, name): name
        for name in (
            "PRIMARY_STATE_UNKNOWN",
            "PRIMARY_STATE_UNCONFIGURED",
            "PRIMARY_STATE_INACTIVE",
            "PRIMARY_STATE_ACTIVE",
            "PRIMARY_STATE_FINALIZED",
            "TRANSITION_STATE_CONFIGURING",
            "TRANSITION_STATE_CLEANINGUP",
            "TRANSITION_STATE_SHUTTINGDOWN",
            "TRANSITION_STATE_ACTIVATING",
            "TRANSITION_STATE_DEACTIVATING",
            "TRANSITION_STATE_ERRORPROCESSING",
        )
    }

    def __init__(self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int) -> None:
        if transition_id not in self.valid_transitions:
            known = ", ".join(f"{name}: {number}" for number, name in self.valid_transitions.items())
            raise ValueError(f"given transition_id of '{transition_id}', expected one of {{{known}}}")
        self.__matcher, self.__transition_id = lifecycle_node_matcher, transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[Any], bool]:
        """Returns whether a lifecycle node's action is concerned."""
        return self.__matcher

    @property
    def transition_id(self) -> int:
        """The transition."""
        return self.__transition_id


class StateTransition(Event):
    """A lifecycle node has made a transition: `msg` came on its topic transition_event."""

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: Any, msg: TransitionEvent) -> None:
        self.__action, self.__msg = action, msg

    @property
    def action(self) -> Any:
        """The `LifecycleNode`."""
        return self.__action

    @property
    def msg(self) -> TransitionEvent:
        """The message."""
        return self.__msg

    @property
    def timestamp(self) -> int:
        """The message's stamp."""
        return self.__msg.timestamp

    @property
    def transition(self) -> str:
        """The transition's label; Jazzy's nodes leave it empty."""
        return self.__msg.transition.label

    @property
    def start_state(self) -> str:
        """The label of the state before, for example "configuring"."""
        return self.__msg.start_state.label

    @property
    def goal_state(self) -> str:
        """The label of the state after, for example "inactive"."""
        return self.__msg.goal_state.label


def matches_node_name(node_name: str) -> Callable[[Any], bool]:
    """Work like `launch_ros.events.matches_node_name`, with a warning."""
    warnings.warn(
        "'matches_node_name' has been moved into the 'launch.events' module and will be removed "
        "from the 'lifecycle' module in the future",
        stacklevel=2,
    )
    return matchers.matches_node_name(node_name)
