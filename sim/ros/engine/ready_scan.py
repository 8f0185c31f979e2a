"""Asking the entities of one executor, in the order of their creation, what work they have."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.action import ActionClient, ActionServer
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.subscription import Subscription

from sim.ros.engine.callbacks import Work, state_of
from sim.ros.engine.waitables import is_ready
from sim.ros.messages.codec import encode, expect
from sim.ros.recorder.kept import ServiceRecord
from sim.ros.transport.action_endpoints import take_at_client, take_at_server
from sim.ros.transport.service_transport import ServiceTransport

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

RCLError = _rclpy.RCLError
# What a QoS event tells of, by what it is: others have come or gone, or don't fit.
CHANGES = "total_count_change", "current_count_change", "alive_count_change", "not_alive_count_change"
MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


class ReadyScan:
    """The entities of one executor, each with the question whether it is ready.

    busy: whether a callback of the executor is under way, so that callback groups matter.
    """

    def __init__(self, executor: Any, engine: Engine, busy: Callable[[], bool]) -> None:
        self.executor, self.engine = executor, engine
        self.timers: list[Any] = []
        self._busy = busy
        self._entries: list[tuple[Callable[..., Work | None], Any, Any]] = []
        self._events: list[tuple[Callable[..., Work | None], Any, Any]] = []
        self._built_for = -1

    def ready(self, nodes: Collection[Any] | None = None) -> Iterator[Work]:
        """One pass over all entities: the work of each that is ready when its turn comes.

        nodes: ask only entities of these; None for all.
        """
        executor = self.executor
        if executor._tasks:
            for task, entity, node in reversed(executor._tasks):
                waiting = state_of(task).seen == self.engine.activity
                if not (waiting or task.executing() or task.done() or task.cancelled()):
                    yield Work("task", None, node, task, (), getattr(entity, "callback", None))
            executor._tasks = [t for t in executor._tasks if not (t[0].done() or t[0].cancelled())]
        entries = self._entries
        if self._built_for != self.engine.topology:
            self._build()
            entries = self._events + self._entries  # QoS events come only when endpoints come or go
        if nodes is not None:
            entries = [entry for entry in entries if entry[2] in nodes]
        for entry, entity, node in entries:
            try:
                work = entry(self, entity, node)
            except (InvalidHandle, RCLError):  # destroyed since the pass began
                continue
            if work is not None:
                yield work

    def _build(self) -> None:
        self._entries, self._events, self.timers = [], [], []
        for node in list(self.executor._nodes):
            # Nothing outside this run can call a service, so without a client there is nothing to ask.
            services = node.services if self.engine.has_clients else ()
            clock_subscription = node._time_source._clock_sub
            self.timers += node.timers
            handlers = [w for w in node.waitables if isinstance(w, EventHandler)]
            self._events += [(ReadyScan._event, w, node) for w in handlers if "_sim" not in w.__dict__]
            self._entries += [(ReadyScan._status, w, node) for w in handlers if "_sim" in w.__dict__]
            self._entries += [
                *((self._entry_of(w), w, node) for w in node.waitables if not isinstance(w, EventHandler)),
                *((ReadyScan._timer, timer, node) for timer in node.timers),
                *(
                    (ReadyScan._subscription, s, node)
                    for s in node.subscriptions
                    if s is not clock_subscription
                ),
                *((ReadyScan._guard, guard, node) for guard in node.guards),
                *((ReadyScan._client, client, node) for client in node.clients),
                *((ReadyScan._service, service, node) for service in services),
            ]
        self._built_for = self.engine.topology

    def _entry_of(self, waitable: Any) -> Callable[..., Work | None]:
        for kind, entry in self._ACTIONS.items():
            if isinstance(waitable, kind):
                return entry
        self.engine.eager = True  # nothing tells when it becomes ready
        return ReadyScan._own_waitable

    def _timer(self, timer: Any, node: Any) -> Work | None:
        if not timer.handle.is_timer_ready() or not self._free(timer):
            return None
        timer.handle.call_timer()
        return Work("timer", timer, node, timer.callback)

    def _subscription(self, subscription: Any, node: Any) -> Work | None:
        sent = subscription._sim.take() if self._free(subscription) else None
        if sent is None:
            return None
        if subscription._callback_type is MESSAGE_ONLY:
            arguments = (sent.message,)
        else:
            arguments = sent.message, sent.information(self.engine.now)
        return Work("subscription", subscription, node, subscription.callback, arguments)

    def _guard(self, guard: Any, node: Any) -> Work | None:
        if not guard._executor_triggered or not self._free(guard):
            return None
        guard._executor_triggered = False
        return Work("guard condition", guard, node, guard.callback)

    def _client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        post = self.engine.post
        taken = (
            client.handle.take_response(client.srv_type.Response) if post is None else post.response(client)
        )
        header, response = taken or (None, None)
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
        kept: ServiceRecord = service._sim
        asked = self.engine.asked.get(kept.service, 0)
        post = self.engine.post
        if (asked == kept.asked and post is None) or not self._free(service):
            return None
        if post is None:
            request, header = service.handle.service_take_request(service.srv_type.Request)
        else:
            request, header = post.request(service) or (None, None)
        if header is None:
            kept.asked = asked
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
        data = self._come_to(server, take_at_server, ServiceTransport.at_server)
        if server._goal_handles and server._sim.swept != self.engine.now:
            server._sim.swept = self.engine.now
            with server._lock:
                expired = server._handle.expire_goals(len(server._goal_handles))
            if expired:
                data["expired"] = expired
        return self._waitable(server, node, data, "action") if data else None

    def _action_client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        data = self._come_to(client, take_at_client, ServiceTransport.at_client)
        if not data:
            return None
        self.engine.recorder.goals.client_took(client, data)
        return self._waitable(client, node, data, "action")

    def _come_to(
        self, end: Any, taken: Callable[[Any], dict], through_network: Callable[[ServiceTransport, Any], dict]
    ) -> dict[str, Any]:
        """What has come to an end of an action. To look takes 60 us, so something must have been sent."""
        engine, kept = self.engine, end._sim
        if engine.post is not None:
            return through_network(engine.post, end)
        if kept.seen == engine.exchanged:
            return {}
        sent = engine.exchanged
        data = taken(end)
        if not data:
            kept.seen = sent
        return data

    def _event(self, handler: Any, node: Any) -> Work | None:
        handler._ready_to_take_data = True
        data = handler.take_data()
        if data is None or not any(getattr(data, name, 0) for name in CHANGES):
            return None
        return self._waitable(handler, node, data, "event")

    def _status(self, handler: Any, node: Any) -> Work | None:
        data = handler._sim.take() if self._free(handler) else None
        if data is None:
            return None
        return self._waitable(handler, node, data, "event")._replace(names=handler.callback)

    def _waitable(self, waitable: Any, node: Any, data: Any, kind: str) -> Work:
        for future in waitable._futures:
            future._set_executor(self.executor)
        return Work(kind, waitable, node, waitable.execute, (data,))

    def _own_waitable(self, waitable: Any, node: Any) -> Work | None:
        if not self._free(waitable) or not is_ready(waitable, self.engine.context):
            return None
        return self._waitable(waitable, node, waitable.take_data(), "waitable")

    _ACTIONS: ClassVar[dict[type, Callable]] = {ActionServer: _action_server, ActionClient: _action_client}

    def _free(self, entity: Any) -> bool:
        if not self._busy():
            return True  # no callback is under way, so no group can be busy
        group = entity.callback_group
        return group is None or group.can_execute(entity)
