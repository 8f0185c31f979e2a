"""What rclpy's executors do with a wait set, done by asking each entity in turn.

Asking is cheaper than waiting (a wait set costs 140 us, a question 1 us) and has one order: that of creation.
Callback groups, coroutines and parallel callbacks keep the meaning that rclpy gives them.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.action import ActionClient, ActionServer
from rclpy.event_handler import EventHandler
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, TimeoutObject
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.subscription import Subscription

from sim.ros.callbacks import Work, perform
from sim.ros.fibers import Fiber, nanoseconds
from sim.ros.processes import shared_context

if TYPE_CHECKING:
    from sim.ros.engine import Engine

RCLError = _rclpy.RCLError
MESSAGE_ONLY = Subscription.CallbackType.MessageOnly


def never() -> bool:
    """The condition of a spin that waits for nothing in particular."""
    return False


class OrderedNodes(dict):
    """Stands for an executor's set of nodes; a set's order differs from process to process."""

    def add(self, node: Any) -> None:
        """As `set.add`."""
        self[node] = None

    def remove(self, node: Any) -> None:
        """As `set.remove`."""
        del self[node]


class Plan:
    """The entities of one executor, in order, each with the question whether it is ready."""

    def __init__(self, executor: Any, engine: Engine) -> None:
        self.executor, self.engine = executor, engine
        self.timers: list[Any] = []
        self.running: list[Fiber] = []  # parallel callbacks of a multi-threaded executor
        self._questions: list[tuple[Callable[[Any], Work | None], Any, Any]] = []
        self._events: list[tuple[Callable[[Any], Work | None], Any, Any]] = []
        self._built_for = -1
        self._pass: Iterator[Work] | None = None
        self._depth = 0  # callbacks of this executor that are on the stack

    # -- questions: the work that an entity has, or None -------------------------------------------

    def _build(self) -> None:
        self._questions, self._events, self.timers = [], [], []
        for node in list(self.executor._nodes):
            # Nothing outside this run can call a service, so without a client there is nothing to ask.
            services = node.services if self.engine.has_clients else ()
            clock_subscription = node._time_source._clock_sub
            self.timers += node.timers
            self._events += [(Plan._event, w, node) for w in node.waitables if isinstance(w, EventHandler)]
            self._questions += [
                *((self._ACTIONS[type(w)], w, node) for w in node.waitables if type(w) in self._ACTIONS),
                *((Plan._timer, timer, node) for timer in node.timers),
                *((Plan._subscription, s, node) for s in node.subscriptions if s is not clock_subscription),
                *((Plan._guard, guard, node) for guard in node.guards),
                *((Plan._client, client, node) for client in node.clients),
                *((Plan._service, service, node) for service in services),
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
        if subscription._callback_type is MESSAGE_ONLY:
            arguments = (taken[0],)
        else:
            arguments = taken[0], self.engine.time.in_simulated_time(taken[1])
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
        future._set_executor(self.executor)
        future.set_result(response)

    def _service(self, service: Any, node: Any) -> Work | None:
        if not self._free(service):
            return None
        request, header = service.handle.service_take_request(service.srv_type.Request)
        if header is None:
            return None

        def answer() -> None:
            service.send_response(service.callback(request, service.srv_type.Response()), header)

        async def answer_later() -> None:
            service.send_response(await service.callback(request, service.srv_type.Response()), header)

        call = answer_later if inspect.iscoroutinefunction(service.callback) else answer
        return Work("service", service, node, call, (), service.callback)

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
        return self._waitable(client, node, client.take_data(), "action")

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
        if not self._depth and not self.running and not self.executor._tasks:
            return True  # no callback is under way, so no group can be busy
        group = entity.callback_group
        return group is None or group.can_execute(entity)

    # -- one pass over all questions ---------------------------------------------------------------

    def _ready(self) -> Iterator[Work]:
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

    def _next(self) -> Iterator[Work]:
        """Ready work: the rest of the pass under way first, then one whole new pass."""
        if self._depth:  # a callback spins: the pass under way isn't its own
            yield from self._ready()
            return
        for _ in range(1 if self._pass is None else 2):
            if self._pass is None:
                self._pass = self._ready()
            # Not `yield from`: that would close the pass together with this generator.
            for work in self._pass:  # noqa: UP028
                yield work
            self._pass = None

    # -- spinning ----------------------------------------------------------------------------------

    def spin_once(
        self, timeout: float | TimeoutObject | None, done: Callable[[], bool], parallel: bool
    ) -> None:
        """Run one callback, waiting for it up to `timeout` simulated seconds (None or negative: for ever)."""
        engine = self.engine
        engine.current.process.check_init()
        if isinstance(timeout, TimeoutObject):
            timeout = timeout.timeout
        until = None if timeout is None or timeout < 0 else engine.now + nanoseconds(timeout)
        try:
            engine.eager |= parallel
            while not self._over(done, parallel):
                if self.running:
                    self._collect()
                if self._run_one(parallel) or (until is not None and engine.now >= until):
                    return
                ready = None if done is never else done
                engine.wait("spin()", ready=ready, until=until, spinning=self)
        finally:
            engine.student_code_ran()

    def _over(self, done: Callable[[], bool], parallel: bool) -> bool:
        if self.executor._is_shutdown or (done is not never and done()):
            return True
        if shared_context(self.executor.context).alive:
            return False
        if parallel:  # rclpy's MultiThreadedExecutor ends quietly
            return True
        raise ExternalShutdownException()

    def _run_one(self, parallel: bool) -> bool:
        if parallel and len(self.running) >= self.executor._executor._max_workers:
            return False
        for work in self._next():
            if parallel:
                self._start(work)
                return True
            self._depth += 1
            try:
                if perform(self.engine, self.executor, work):
                    return True
            finally:
                self._depth -= 1
        return False

    def _start(self, work: Work) -> None:
        """Run a callback in a fiber of its own, at once."""
        engine, spinner = self.engine, self.engine.current
        if work.entity is None:
            work.call._sim_seen = engine.activity
        elif work.entity.callback_group is not None:
            work.entity.callback_group.beginning_execution(work.entity)
        body = partial(perform, engine, self.executor, work, begun=True)
        self.running.append(engine.spawn(body, spinner.name, spinner.process, before=spinner))

    def _collect(self) -> None:
        """Let an exception of a parallel callback leave spin(), as rclpy does."""
        for fiber in [f for f in self.running if f.done]:
            self.running.remove(fiber)
            if fiber.error is not None:
                raise fiber.error
