"""Looks for ready work among the entities of one executor, in the order of their creation."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from typing import Any, ClassVar

from rclpy.action import ActionClient, ActionServer
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.subscription import Subscription

from sim.distro import DISTRO
from sim.evidence import SPUN
from sim.ros.engine.awaits import waits_for_a_future
from sim.ros.engine.callbacks import Work, state_of
from sim.ros.engine.engine import Engine
from sim.ros.engine.ready_order import ReadyOrder
from sim.ros.engine.service_work import is_called, response_work, service_work
from sim.ros.engine.waitables import is_ready
from sim.ros.fibers.waiter import Waiter
from sim.ros.rclpy_cpp import cpp
from sim.ros.recorder.records import ACTION, SERVICE
from sim.ros.transport.action_endpoints import take_at_client, take_at_server
from sim.ros.transport.middleware import MiddlewareReader
from sim.ros.transport.qos_events import EVENT_COUNTS
from sim.ros.transport.reader import READER
from sim.ros.transport.service_transport import ServiceTransport

# What an event of the middleware counts: matched or incompatible endpoints.
CHANGES = "total_count_change", "current_count_change", "alive_count_change", "not_alive_count_change"
TASK_ORDER = -1 if DISTRO == "jazzy" else 1  # Jazzy's executors begin with the newest task
MESSAGE_ONLY = Subscription.CallbackType.MessageOnly

Entry = tuple[Callable[..., Work | None], Any, Any]  # what checks an entity, the entity, its node


class ReadyScan:
    """The entities of one executor, each with the check whether it has work.

    waiter: what represents the executor in the run. busy: whether a callback of the executor is running, so
    that callback groups matter.
    """

    def __init__(self, executor: Any, engine: Engine, waiter: Waiter, busy: Callable[[], bool]) -> None:
        self.executor, self.engine, self._waiter = executor, engine, waiter
        self.timers: list[Any] = []
        self._transport = engine.transport
        self._busy = busy
        self._entries: list[Entry] = []
        is_fixed = engine.choices is None or engine.current.process.from_course
        self._order = None if is_fixed else ReadyOrder(engine.choices)

    def ready(self, nodes: Collection[Any] | None = None) -> Iterator[Work]:
        """One pass over all entities: the work of each that is ready when its turn comes.

        nodes: check only entities of these; None for all.
        """
        if self.executor._tasks:
            yield from self._ready_tasks()
        entries = self.scan_order(nodes)
        if self._order is not None:
            entries = self._order.arranged(entries, self.engine.now)
        for check, entity, node in entries:
            try:
                work = check(self, entity, node)
            except (InvalidHandle, cpp.RCLError):  # destroyed since the pass began
                continue
            if work is not None:
                if self._order is not None:
                    self._order.note(entity)
                yield work

    def _ready_tasks(self) -> Iterator[Work]:
        executor, waiter = self.executor, self._waiter
        self._poll()
        for task, entity, node in executor._tasks[::TASK_ORDER]:
            waits = state_of(task).seen_wakes == waiter.wakes or waits_for_a_future(task)
            if not (waits or task.executing() or task.done() or task.cancelled()):
                yield Work("task", None, node, task, (), getattr(entity, "callback", None))
        executor._tasks = [t for t in executor._tasks if not (t[0].done() or t[0].cancelled())]

    def scan_order(self, nodes: Collection[Any] | None) -> list[Entry]:
        """The entities in the order in which they are checked: node by node and kind by kind, as created."""
        entries = self._entries
        if self._waiter.outdated:
            events = self._build()
            entries = events + self._entries  # the middleware has QoS events only when endpoints come or go
        return entries if nodes is None else [entry for entry in entries if entry[2] in nodes]

    def _poll(self) -> None:
        """Something here becomes ready without an event that wakes the executor."""
        self.engine.waiters.poll(self._waiter)

    def _build(self) -> list[Entry]:
        """List the entities anew; returns the QoS events of the middleware."""
        self._waiter.outdated = False
        self._entries, self.timers = [], []
        events: list[Entry] = []
        for node in list(self.executor._nodes):
            subscriptions = self._subscriptions(node)  # first: a class in its place fails here
            self.engine.recorder.node_fact(node, SPUN)
            handlers = [w for w in node.waitables if isinstance(w, EventHandler)]
            events += [(ReadyScan._event, w, node) for w in handlers if EVENT_COUNTS.find(w) is None]
            self.timers += node.timers
            self._entries += [
                *((ReadyScan._counted_event, w, node) for w in handlers if EVENT_COUNTS.find(w) is not None),
                *((self._check_of(w), w, node) for w in node.waitables if not isinstance(w, EventHandler)),
                *((ReadyScan._timer, timer, node) for timer in node.timers),
                *((ReadyScan._subscription, s, node) for s in subscriptions),
                *((ReadyScan._guard_condition, guard, node) for guard in node.guards),
                *((ReadyScan._client, client, node) for client in node.clients),
                *((ReadyScan._service, service, node) for service in node.services if is_called(service)),
            ]
        return events

    def _subscriptions(self, node: Any) -> list[Any]:
        """Those of a node; from now on their messages wake this executor."""
        clock = node._time_source._clock_sub
        found = [subscription for subscription in node.subscriptions if subscription is not clock]
        for subscription in found:
            reader = READER.of(subscription)
            reader.waiter = self._waiter
            if isinstance(reader, MiddlewareReader):
                self._poll()
        return found

    def _check_of(self, waitable: Any) -> Callable[..., Work | None]:
        for kind, check in self._ACTIONS.items():
            if isinstance(waitable, kind):
                return check
        self._poll()
        return ReadyScan._own_waitable

    def _timer(self, timer: Any, node: Any) -> Work | None:
        if not timer.handle.is_timer_ready() or not self._free(timer):
            return None
        timer.handle.call_timer()
        return Work("timer", timer, node, timer.callback)

    def _subscription(self, subscription: Any, node: Any) -> Work | None:
        sent = READER.of(subscription).take() if self._free(subscription) else None
        if sent is None:
            return None
        if subscription._callback_type is MESSAGE_ONLY:
            arguments = (sent.message,)
        else:
            arguments = sent.message, sent.information(self.engine.now, self.engine.epoch)
        return Work("subscription", subscription, node, subscription.callback, arguments)

    def _guard_condition(self, guard: Any, node: Any) -> Work | None:
        if not guard._executor_triggered or not self._free(guard):
            return None
        guard._executor_triggered = False
        return Work("guard condition", guard, node, guard.callback)

    def _client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        network = self._transport.services
        if network is None:
            taken = client.handle.take_response(client.srv_type.Response)
        else:
            taken = network.response(client)
        header, response = taken or (None, None)
        if header is None:
            return None
        return response_work(self.engine.recorder.calls, self.executor, client, node, header, response)

    def _service(self, service: Any, node: Any) -> Work | None:
        record = SERVICE.of(service)
        network = self._transport.services
        if not (record.has_requests or network is not None) or not self._free(service):
            return None
        if network is None:
            request, header = service.handle.service_take_request(service.srv_type.Request)
        else:
            request, header = network.request(service) or (None, None)
        if header is None:
            record.has_requests = False
            return None
        return service_work(self.engine.recorder.calls, service, node, request, header)

    def _action_server(self, server: Any, node: Any) -> Work | None:
        if not self._free(server):
            return None
        data = self._arrived(server, take_at_server, ServiceTransport.at_server)
        record = ACTION.of(server)
        if server._goal_handles:
            self._poll()  # they expire as time passes
            if record.swept != self.engine.now:
                record.swept = self.engine.now
                with server._lock:
                    expired = server._handle.expire_goals(len(server._goal_handles))
                if expired:
                    data["expired"] = expired
        return self._waitable(server, node, data, "action") if data else None

    def _action_client(self, client: Any, node: Any) -> Work | None:
        if not self._free(client):
            return None
        data = self._arrived(client, take_at_client, ServiceTransport.at_client)
        if not data:
            return None
        self.engine.recorder.goals.client_took(client, data)
        return self._waitable(client, node, data, "action")

    def _arrived(
        self, endpoint: Any, take: Callable[[Any], dict], through: Callable[[ServiceTransport, Any], dict]
    ) -> dict[str, Any]:
        """Return what has arrived at an endpoint of an action. Looking takes 60 us, so only if need be."""
        network, record = self._transport.services, ACTION.of(endpoint)
        if network is not None:
            return through(network, endpoint)
        if not record.has_news:
            return {}
        record.has_news = False  # unless more is sent while it looks
        data = take(endpoint)
        record.has_news |= bool(data)
        return data

    def _event(self, handler: Any, node: Any) -> Work | None:
        handler._ready_to_take_data = True
        data = handler.take_data()
        if data is None or not any(getattr(data, name, 0) for name in CHANGES):
            return None
        return self._waitable(handler, node, data, "event")

    def _counted_event(self, handler: Any, node: Any) -> Work | None:
        data = EVENT_COUNTS.of(handler).take() if self._free(handler) else None
        work = None if data is None else self._waitable(handler, node, data, "event")
        return work and work._replace(names=handler.callback)

    def _waitable(self, waitable: Any, node: Any, data: Any, kind: str) -> Work:
        for future in waitable._futures:
            future._set_executor(self.executor)
        return Work(kind, waitable, node, waitable.execute, (data,))

    def _own_waitable(self, waitable: Any, node: Any) -> Work | None:
        if not self._free(waitable) or not is_ready(waitable, self.engine.rclpy.context):
            return None
        return self._waitable(waitable, node, waitable.take_data(), "waitable")

    _ACTIONS: ClassVar[dict[type, Callable]] = {ActionServer: _action_server, ActionClient: _action_client}

    def _free(self, entity: Any) -> bool:
        if not self._busy():
            return True  # no callback is under way, so no group can be busy
        group = entity.callback_group
        return group is None or group.can_execute(entity)
