"""The action `LifecycleTransition`."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import Any, ClassVar

from launch.action import Action
from launch.actions import EmitEvent
from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType
from launch.utilities import normalize_to_list_of_substitutions, text_of
from lifecycle_msgs.msg import Transition

from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.events.matchers import matches_node_name

_SHUTDOWN = {"start_state": "shuttingdown", "goal_state": "finalized"}


class LifecycleTransition(Action):
    """Requests transitions of lifecycle nodes, each when the node has reached the goal of the one before.

    After an error in a node's callback, that node's remaining transitions are dropped.
    """

    transition_targets: ClassVar = {
        Transition.TRANSITION_CONFIGURE: {"start_state": "configuring", "goal_state": "inactive"},
        Transition.TRANSITION_CLEANUP: {"start_state": "cleaningup", "goal_state": "unconfigured"},
        Transition.TRANSITION_ACTIVATE: {"start_state": "activating", "goal_state": "active"},
        Transition.TRANSITION_DEACTIVATE: {"start_state": "deactivating", "goal_state": "inactive"},
        Transition.TRANSITION_UNCONFIGURED_SHUTDOWN: _SHUTDOWN,
        Transition.TRANSITION_INACTIVE_SHUTDOWN: _SHUTDOWN,
        Transition.TRANSITION_ACTIVE_SHUTDOWN: _SHUTDOWN,
    }

    def __init__(
        self,
        *,
        lifecycle_node_names: Sequence[SomeSubstitutionsType],
        transition_ids: Sequence[int | SomeSubstitutionsType],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if len(transition_ids) == 0:
            raise ValueError("No transition_ids provided.")
        if len(lifecycle_node_names) == 0:
            raise ValueError("No lifecycle_node_names provided.")
        self.__names = [normalize_to_list_of_substitutions(name) for name in lifecycle_node_names]
        texts = [str(each) if isinstance(each, int) else each for each in transition_ids]
        self.__ids = [normalize_to_list_of_substitutions(text) for text in texts]

    def execute(self, context: LaunchContext) -> list[Action]:
        """Work like `Action`."""
        ids = [self.__number(text_of(context, each)) for each in self.__ids]
        first = []
        for name in [text_of(context, each) for each in self.__names]:
            is_node = matches_node_name(name)
            events = [ChangeState(lifecycle_node_matcher=is_node, transition_id=each) for each in ids]
            requests = [EmitEvent(event=event) for event in events]
            goals = [self.transition_targets[each] for each in ids]
            context.register_event_handler(_Sequence(name, goals, requests[1:]))
            first.append(requests[0])
        return first

    def __number(self, text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            raise ValueError(f"expected integer for lifecycle transition, got {text}") from None
        if number in ChangeState.valid_transitions and number not in self.transition_targets:
            known = ", ".join(str(each) for each in self.transition_targets)
            raise ValueError(f"lifecycle transition {number} has no goal to wait for: there are {known}")
        return number


class _Sequence(BaseEventHandler):
    """Emits the next request to a node whenever a transition has reached its goal."""

    def __init__(self, name: str, goals: list[dict[str, str]], requests: list[EmitEvent]) -> None:
        super().__init__(matcher=self.__concerns)
        self.__name, self.__is_node = name, matches_node_name(name)
        self.__goals, self.__requests = list(goals), list(requests)

    def __concerns(self, event: Event) -> bool:
        return isinstance(event, StateTransition) and self.__is_node(event.action)

    def handle(self, event: Event, context: LaunchContext) -> list[Action]:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        if event.goal_state == "errorprocessing":
            get_logger("launch_ros.actions.lifecycle_transition").info(
                f"Stopping transitions for {self.__name} because 'error occured during transitions'"
            )
            self.__goals.clear()
        elif {"start_state": event.start_state, "goal_state": event.goal_state} == self.__goals[0]:
            del self.__goals[0]
            if self.__goals:
                return [self.__requests.pop(0)]
        if not self.__goals:
            with contextlib.suppress(ValueError):
                context.unregister_event_handler(self)
        return []
