"""Connects a lifecycle node with the events of a launch file."""

from __future__ import annotations

import asyncio
from typing import Any

from launch.action import Action
from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from lifecycle_msgs.msg import TransitionEvent
from lifecycle_msgs.srv import ChangeState as ChangeStateService

from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_node

_PERIOD = 0.1  # seconds between two looks at whether the service is there, or launch is shutting down


class LifecycleEventManager:
    """Emits a `StateTransition` for each transition of a node, and makes requests to it of `ChangeState`."""

    def __init__(self, lifecycle_node: Any) -> None:
        self.__node = lifecycle_node
        self.__logger = get_logger("launch_ros.utilities.lifecycle_event_manager")
        self.__client: Any = None

    @property
    def node_name(self) -> str:
        """The full name of the lifecycle node."""
        return self.__node.node_name

    def setup_lifecycle_manager(self, context: LaunchContext) -> None:
        """Subscribe to the node's transitions, create the client of its service, and register the handler."""
        loop = context.asyncio_loop

        def on_transition(message: TransitionEvent) -> None:
            event = StateTransition(action=self.__node, msg=message)
            loop.call_soon_threadsafe(context.emit_event_sync, event)

        node = get_ros_node(context)
        node.create_subscription(TransitionEvent, f"{self.node_name}/transition_event", on_transition, 10)
        self.__client = node.create_client(ChangeStateService, f"{self.node_name}/change_state")
        context.register_event_handler(_OnChangeState(self, self.__node))

    async def change_state(self, context: LaunchContext, transition_id: int) -> None:
        """Request a transition, and wait for the response. Gives up on shutdown, and when the node exits."""
        while not self.__client.service_is_ready():
            if self.__abandons(context, "service"):
                return
            await asyncio.sleep(_PERIOD)
        request = ChangeStateService.Request()
        request.transition.id = transition_id
        loop, answered = context.asyncio_loop, context.asyncio_loop.create_future()
        response = self.__client.call_async(request)
        response.add_done_callback(lambda _: loop.call_soon_threadsafe(answered.set_result, None))
        while not answered.done():
            if self.__abandons(context, "service response"):
                response.cancel()
                return
            await asyncio.wait([answered], timeout=_PERIOD)
        if not response.result().success:
            name = ChangeState.valid_transitions[transition_id]
            self.__logger.error(f"Failed to make transition '{name}' for LifecycleNode '{self.node_name}'")

    def __abandons(self, context: LaunchContext, what: str) -> bool:
        """Return whether there is a reason to wait no longer, which is logged."""
        complete = self.__node.get_asyncio_future()
        if context.is_shutdown:
            reason = "due to shutdown"
        elif complete is not None and complete.done():
            reason = "because the node has exited"  # upstream waits on
        else:
            return False
        self.__logger.warning(f"Abandoning wait for the '{self.__client.srv_name}' {what}, {reason}.")
        return True


class _OnChangeState(BaseEventHandler):
    """Makes a request of each `ChangeState` event that concerns a node."""

    def __init__(self, manager: LifecycleEventManager, node: Any) -> None:
        super().__init__(matcher=lambda event: isinstance(event, ChangeState))
        self.__manager, self.__node = manager, node

    def handle(self, event: Event, context: LaunchContext) -> list[Action]:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        if not event.lifecycle_node_matcher(self.__node):
            return []
        return [_Request(self.__manager, event.transition_id)]


class _Request(Action):
    """Requests a transition; it is complete with the response."""

    def __init__(self, manager: LifecycleEventManager, transition_id: int) -> None:
        super().__init__()
        self.__manager, self.__transition_id = manager, transition_id
        self.__task: asyncio.Task | None = None

    def get_asyncio_future(self) -> asyncio.Future | None:
        """Work like `LaunchDescriptionEntity`."""
        return self.__task

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        request = self.__manager.change_state(context, self.__transition_id)
        self.__task = context.asyncio_loop.create_task(request)
