"""Action servers and clients for the graph; goals for the recording.

What an action sends goes through C++, past Python's publishers and clients. So it is recorded where rclpy's
Python code decides on it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.node import Node
from rclpy.task import Future

from sim.ros.fibers.scheduler import active, engine
from sim.ros.hooks.contexts import INVALID, is_shut_down, require_context
from sim.ros.hooks.table import hook
from sim.ros.messages.codec import encode, expect
from sim.ros.rclpy_cpp import cpp
from sim.ros.recorder.action_goals import key
from sim.ros.recorder.records import ACTION


def _action_end(owner: type, kind: str) -> None:
    @hook(owner, "__init__", "the graph")
    def init(original: Callable) -> Callable:
        def __init__(
            self: Any, node: Node, action_type: Any, action_name: str, *more: Any, **keywords: Any
        ) -> None:
            if is_shut_down(getattr(node, "_context", None)):
                raise ValueError(f"Failed to create {kind}: {INVALID}")
            original(self, node, action_type, action_name, *more, **keywords)
            run = engine()
            if run is not None:
                name = node.resolve_service_name(action_name)
                serves = kind == "action server"
                if not serves:
                    run.waiters.endpoints_changed()
                handle = self._handle if serves else self._client_handle
                run.recorder.endpoint(kind, node, name, action_type, handle=handle)
                run.recorder.goals.endpoint_created(self, node, name, action_type, serves=serves)

        return __init__


_action_end(ActionServer, "action server")
_action_end(ActionClient, "action client")


def _counted(original: Callable) -> Callable:
    def counted(self: Any, *arguments: Any) -> Any:
        run = active()  # also where a proxy of another process sends
        if run is not None:
            run.transport.sent_by_middleware()
        return original(self, *arguments)

    return counted


for _owner, _names in (
    (cpp.ActionServer, ("send_goal_response", "send_cancel_response", "send_result_response")),
    (cpp.ActionServer, ("publish_feedback", "publish_status")),
    (cpp.ActionClient, ("send_cancel_request", "send_result_request")),
    (cpp.Service, ("service_send_response",)),
    (cpp.Publisher, ("publish_raw",)),
):
    for _name in _names:
        hook(_owner, _name, "endpoints of actions are polled only when something was sent")(_counted)


@hook(ActionClient, "send_goal_async", "every goal is recorded as the bytes that are sent")
def send_goal_async(original: Callable) -> Callable:
    def send_goal_async(self: ActionClient, goal: Any, *arguments: Any, **keywords: Any) -> Future:
        run = engine()
        if run is None:
            return original(self, goal, *arguments, **keywords)
        expect(goal, self._action_type.Goal)
        run.limits.count_request()
        raw = encode(goal)
        with run.recorder.calls.sending(run.recorder.goals.discovered(self)):
            future = original(self, goal, *arguments, **keywords)
        run.transport.request_sent(f"{ACTION.of(self).action}/_action/send_goal")
        number, goal_id = next(reversed(self._goal_sequence_number_to_goal_id.items()))
        run.recorder.goals.goal_sent(self, number, goal_id, raw)
        return future

    return send_goal_async


@hook(cpp.ActionClient, "send_goal_request", "a goal that is sent before discovery is lost")
def send_goal_request(original: Callable) -> Callable:
    def send_goal_request(self: Any, request: Any) -> int:
        run = engine()
        lost = None if run is None else run.recorder.calls.lost_request_number()
        if lost is not None:
            return lost
        return _counted(original)(self, request)

    return send_goal_request


@hook(ActionClient, "server_is_ready", "a client that finds a server ready has discovered it")
def server_is_ready(original: Callable) -> Callable:
    def server_is_ready(self: ActionClient) -> bool:
        require_context(self._node, "Failed to check if action server is available")
        ready = original(self)
        record = ACTION.find(self)
        if engine() is not None and ready and record is not None:
            record.server_seen = True
        return ready

    return server_is_ready


@hook(ActionClient, "send_goal", "its TypeError has no text")
def send_goal(original: Callable) -> Callable:
    def send_goal(self: ActionClient, goal: Any, **keywords: Any) -> Any:
        if engine() is not None:
            expect(goal, self._action_type.Goal)
        return original(self, goal, **keywords)

    return send_goal


@hook(ActionClient, "_cancel_goal_async", "the recording has the time of each cancel request")
def cancel_goal_async(original: Callable) -> Callable:
    def _cancel_goal_async(self: ActionClient, goal_handle: Any) -> Future:
        future = original(self, goal_handle)
        run = engine()
        if run is not None:
            run.transport.request_sent(f"{ACTION.of(self).action}/_action/cancel_goal")
            run.recorder.goals.cancel_sent(self, goal_handle.goal_id)
        return future

    return _cancel_goal_async


@hook(ActionClient, "_get_result_async", "a plain service may replace an action server's")
def get_result_async(original: Callable) -> Callable:
    def _get_result_async(self: ActionClient, goal_handle: Any) -> Future:
        future = original(self, goal_handle)
        run = engine()
        if run is not None:
            run.transport.request_sent(f"{ACTION.of(self).action}/_action/get_result")
        return future

    return _get_result_async


@hook(ActionServer, "_execute_goal_request", "the recording has the goals that were rejected")
def execute_goal_request(original: Callable) -> Callable:
    async def _execute_goal_request(self: ActionServer, request_header_and_message: tuple) -> None:
        run = engine()
        if run is None:
            return await original(self, request_header_and_message)
        _, request = request_header_and_message
        goal = run.recorder.goals.goal_taken(self, request.goal_id, request.goal)
        await original(self, request_header_and_message)
        return run.recorder.goals.goal_handled(goal)

    return _execute_goal_request


@hook(ServerGoalHandle, "__init__", "a handle is created first of all for each accepted goal")
def goal_handle_init(original: Callable) -> Callable:
    def __init__(
        self: ServerGoalHandle, action_server: ActionServer, goal_info: Any, goal_request: Any
    ) -> None:
        original(self, action_server, goal_info, goal_request)
        run = engine()
        if run is not None:
            run.recorder.goals.goal_accepted(action_server, goal_info.goal_id)

    return __init__


@hook(ServerGoalHandle, "_update_state", "every status of a goal is recorded")
def update_state(original: Callable) -> Callable:
    def _update_state(self: ServerGoalHandle, event: Any) -> None:
        original(self, event)
        run, handle = engine(), self._goal_handle
        if run is not None and handle is not None:
            run.recorder.goals.status_changed(self._action_server, self.goal_id, handle.get_status())

    return _update_state


@hook(ServerGoalHandle, "publish_feedback", "feedback is recorded as the bytes that are sent")
def publish_feedback(original: Callable) -> Callable:
    def publish_feedback(self: ServerGoalHandle, feedback: Any) -> None:
        run = engine()
        if run is None:
            return original(self, feedback)
        expect(feedback, self._action_server.action_type.Feedback)
        original(self, feedback)
        return run.recorder.goals.feedback_published(self._action_server, self.goal_id, feedback)

    return publish_feedback


@hook(ActionServer, "_execute_cancel_request", "the recording has the goals that could not be canceled")
def execute_cancel_request(original: Callable) -> Callable:
    async def _execute_cancel_request(self: ActionServer, request_header_and_message: tuple) -> None:
        run = engine()
        if run is None:
            return await original(self, request_header_and_message)
        _, request = request_header_and_message
        goal, before = run.recorder.goals.cancel_taken(self, request.goal_info.goal_id)
        await original(self, request_header_and_message)
        return run.recorder.goals.cancel_handled(goal, before)

    return _execute_cancel_request


@hook(
    ActionServer,
    "_execute_goal",
    "rclpy prints an exception of an execute callback and continues; the recording has it, and the result",
)
def execute_goal(original: Callable) -> Callable:
    async def _execute_goal(self: ActionServer, execute_callback: Any, goal_handle: Any) -> None:
        run = engine()
        if run is None:
            return await original(self, execute_callback, goal_handle)
        await original(self, run.callbacks.recorded(execute_callback, self._node), goal_handle)
        future = self._result_futures.get(key(goal_handle.goal_id))
        if future is not None and future.done():
            run.recorder.goals.result_ready(self, goal_handle.goal_id, future.result().result)
        return None

    return _execute_goal
