"""Asking the entities of one executor, in the order of their creation, what work they have."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.action import ActionClient, ActionServer
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.subscription import Subscription

from sim.ros.callbacks import Work
from sim.ros.cdr import canonical
from sim.ros.codec import encode, expect, type_name

if TYPE_CHECKING:
    from sim.ros.engine import Engine

RCLError = _rclpy.RCLError
MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


class Questions:
    """The entities of one executor, each with the question whether it is ready.

    busy: whether a callback of the executor is under way, so that callback groups matter.
    """

    def __init__(self, executor: Any, engine: Engine, busy: Callable[[], bool]) -> None:
        self.executor, self.engine = executor, engine
        self.timers: list[Any] = []
        self._busy = busy
        self._questions: list[tuple[Callable[..., Work | None], Any, Any]] = []
        self._events: list[tuple[Callable[..., Work | None], Any, Any]] = []
        self._built_for = -1

    def ready(self) -> Iterator[Work]:
        """One pass over all entities: the work of each that is ready when its turn comes."""
        executor = self.executor
        if executor._tasks:
            for task, entity, node in list(executor._tasks):
                waiting = getattr(task, "_sim_seen", None) == self.engine.activity
                if not (waiting or task.executing() or task.done() or task.cancelled()):
                    yield Work("task", None, node, task, (), getattr(entity, "callback", None))
            executor._tasks = [t for t in executor._tasks if not (t[0].done() or t[0].cancelled())]
        questions = self._questions
        if self._built_for != self.engine.topology:
            self._build()
            questions = self._events + self._questions  # QoS events come only when endpoints come or go
        for question, entity, node in questions:
            try:
                work = question(self, entity, node)
            except (InvalidHandle, RCLError):  # destroyed since the pass began
                continue
            if work is not None:
                yield work

    def _build(self) -> None:
        self._questions, self._events, self.timers = [], [], []
        for node in list(self.executor._nodes):
            # Nothing outside this run can call a service, so without a client there is nothing to ask.
            services = node.services if self.engine.has_clients else ()
            clock_subscription = node._time_source._clock_sub
            self.timers += node.timers
            self._events += [
                (Questions._event, w, node) for w in node.waitables if isinstance(w, EventHandler)
            ]
            self._questions += [
                *(
                    (question, waitable, node)
                    for waitable in node.waitables
                    for kind, question in self._ACTIONS.items()
                    if isinstance(waitable, kind)
                ),
                *((Questions._timer, timer, node) for timer in node.timers),
                *(
                    (Questions._subscription, s, node)
                    for s in node.subscriptions
                    if s is not clock_subscription
                ),
                *((Questions._guard, guard, node) for guard in node.guards),
                *((Questions._client, client, node) for client in node.clients),
                *((Questions._service, service, node) for service in services),
            ]
        self._built_for = self.engine.topology

    def _timer(self, timer: Any, node: Any) -> Work | None:
        if not timer.handle.is_timer_ready() or not self._free(timer):
            return None
        timer.handle.call_timer()
        return Work("timer", timer, node, timer.callback)

    def _subscription(self, subscription: Any, node: Any) -> Work | None:
        sent = self.engine.sent.get(subscription._sim_topic)
        if (sent is not None and sent == subscription._sim_seen) or not self._free(subscription):
            return None
        taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
        if taken is None:
            subscription._sim_seen = sent
            return None
        message, information = taken
        if subscription.raw:  # DDS leaves what was in memory in gaps and behind the end
            message = canonical(type_name(subscription.msg_type), message)
        if subscription._callback_type is MESSAGE_ONLY:
            arguments = (message,)
        else:
            arguments = message, self.engine.time.in_simulated_time(information)
        return Work("subscription", subscription, node, subscription.callback, arguments)

    def _guard(self, guard: Any, node: Any) -> Work | None:
        if not guard._executor_triggered or not self._free(guard):
            return None
        guard._executor_triggered = False
        return Work("guard condition", guard, node, guard.callback)

    def _client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        header, response = client.handle.take_response(client.srv_type.Response) or (None, None)
        if header is None:
            return None
        return Work("client", client, node, partial(self._complete, client, header, response))

    def _complete(self, client: Any, header: Any, response: Any) -> None:
        try:
            future = client.get_pending_request(header.request_id.sequence_number)
        except KeyError:  # nobody waits for this answer any more
            return
        self.engine.recorder.calls.received(client, header.request_id.sequence_number)
        future._set_executor(self.executor)
        future.set_result(response)

    def _service(self, service: Any, node: Any) -> Work | None:
        asked = self.engine.asked.get(service._sim_name, 0)
        if asked == service._sim_seen or not self._free(service):
            return None
        request, header = service.handle.service_take_request(service.srv_type.Request)
        if header is None:
            service._sim_seen = asked
            return None

        calls = self.engine.recorder.calls
        call = calls.taken(service, node, header.request_id.sequence_number, request)

        def respond(response: Any) -> None:
            expect(response, service.srv_type.Response)
            raw = encode(response)
            service.send_response(response, header)
            calls.answered(call, raw)

        def answer() -> None:
            with calls.answering(call):
                respond(service.callback(request, service.srv_type.Response()))

        async def answer_later() -> None:
            with calls.answering(call):
                respond(await service.callback(request, service.srv_type.Response()))

        function = answer_later if inspect.iscoroutinefunction(service.callback) else answer
        return Work("service", service, node, function, (), service.callback)

    def _action_server(self, server: Any, node: Any) -> Work | None:
        if not self._free(server):
            return None
        server._is_goal_request_ready = server._is_cancel_request_ready = server._is_result_request_ready = (
            True
        )
        server._is_goal_expired = False
        data = server.take_data()
        if server._goal_handles:
            with server._lock:
                expired = server._handle.expire_goals(len(server._goal_handles))
            if expired:
                data["expired"] = expired
        return self._waitable(server, node, data, "action")

    def _action_client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        client._is_goal_response_ready = client._is_cancel_response_ready = (
            client._is_result_response_ready
        ) = True
        client._is_feedback_ready = client._is_status_ready = True
        data = client.take_data()
        if data:
            self.engine.recorder.goals.client_took(client, data)
        return self._waitable(client, node, data, "action")

    def _event(self, handler: Any, node: Any) -> Work | None:
        handler._ready_to_take_data = True
        data = handler.take_data()
        if data is None or not data.total_count_change:
            return None
        return self._waitable(handler, node, data, "event")

    def _waitable(self, waitable: Any, node: Any, data: Any, kind: str) -> Work | None:
        if not data:
            return None
        for future in waitable._futures:
            future._set_executor(self.executor)
        return Work(kind, waitable, node, waitable.execute, (data,))

    _ACTIONS: ClassVar[dict[type, Callable]] = {ActionServer: _action_server, ActionClient: _action_client}

    def _free(self, entity: Any) -> bool:
        if not self._busy():
            return True  # no callback is under way, so no group can be busy
        group = entity.callback_group
        return group is None or group.can_execute(entity)
