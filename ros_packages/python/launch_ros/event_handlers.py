"""The event handlers for nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.event import Event
from launch.event_handler import EventHandler

from launch_ros.events.lifecycle import StateTransition

__all__ = ["OnStateTransition"]


class OnStateTransition(EventHandler):
    """Visits entities when a lifecycle node makes a transition.

    An event has to have everything that is given: the node's action, the transition's label, the labels of
    the states before and after. With a `matcher`, that alone decides.
    """

    def __init__(
        self,
        *,
        entities: Any,
        target_lifecycle_node: Any = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        matcher: Callable[[Event], bool] | None = None,
        **kwargs: Any,
    ) -> None:
        if target_lifecycle_node is not None:
            _check_is_lifecycle_node(target_lifecycle_node)
        wanted = {
            "action": target_lifecycle_node,
            "transition": transition,
            "start_state": start_state,
            "goal_state": goal_state,
        }

        def matches(event: Event) -> bool:
            return isinstance(event, StateTransition) and all(
                value is None or getattr(event, key) == value for key, value in wanted.items()
            )

        super().__init__(matcher=matcher or matches, entities=entities, **kwargs)


def _check_is_lifecycle_node(action: Any) -> None:
    """Raise RuntimeError if it is no action of a lifecycle node."""
    kind = getattr(action, "is_lifecycle_node", None)
    if not kind:
        what = "node type" if kind is None else "lifecycle-enabled node"
        raise RuntimeError(
            'OnStateTransition requires a "LifecycleNode" action as the target, '
            f"target_lifecycle_node is not a {what}."
        )
