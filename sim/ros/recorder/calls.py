"""Writes down the calls of services: who asked, who answered, when, and what."""

from __future__ import annotations

import contextlib
import weakref
from collections import defaultdict, deque
from collections.abc import Iterator
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.qos import HistoryPolicy

from sim.evidence import Call
from sim.ros.messages.cdr import canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.recorder.base import RecorderBase
from sim.ros.recorder.records import ClientRecord, Request, ServiceRecord


class Calls:
    """The calls of one run.

    What a server takes doesn't say who sent it: rclpy hides that part of a request's header. But requests
    come in the order they were sent. So each service has an inbox, which forgets what its queue forgets, and
    what is taken is looked up there.
    """

    def __init__(self, recorder: RecorderBase) -> None:
        self._recorder = recorder
        self._services: dict[str, list[weakref.ref[Any]]] = defaultdict(list)
        self._to_nobody, self._losing = 0, False

    def client_made(self, client: Any, node: Any, name: str) -> None:
        """A node made a client of the service of this resolved name."""
        kept = {"service": name, "type": type_name(client.srv_type), "node": self._recorder.name_of(node)}
        client._sim = ClientRecord(*self._recorder.maker(), **kept)

    def service_made(self, service: Any) -> None:
        """A node made a service: from now on requests reach it."""
        profile = service.qos_profile
        keeps_last = profile.history is HistoryPolicy.KEEP_LAST
        inbox: deque[Request] = deque(maxlen=max(profile.depth, 1) if keeps_last else None)
        service._sim = ServiceRecord(*self._recorder.maker(), service=service.service_name, inbox=inbox)
        self._services[service.service_name].append(weakref.ref(service))

    def servers(self, service: str) -> list[Any]:
        """The services of this resolved name that exist."""
        made = (known() for known in self._services[service])
        return [server for server in made if server is not None and alive(server.handle)]

    def discovered(self, client: Any) -> bool:
        """Whether a request of a client would reach a server, if there is one."""
        there = [server._sim for server in self.servers(client._sim.service)]
        return client._sim.reaches(there, self._recorder.scheduler.now)

    @contextlib.contextmanager
    def reaching(self, discovered: bool) -> Iterator[None]:
        """For the time in which a request or a goal is sent; it is lost where nobody was discovered."""
        self._losing = not discovered
        try:
            yield
        finally:
            self._losing = False

    def lost_number(self) -> int | None:
        """The number of a request that nobody gets, below 0; None where requests are sent."""
        if not self._losing:
            return None
        self._to_nobody -= 1
        return self._to_nobody

    def asked(self, client: Any, number: int, raw: bytes) -> None:
        """A client sent a request; one of a number below 0 gets lost."""
        recorder = self._recorder
        if not recorder.open:
            return
        kept: ClientRecord = client._sim
        recorder.count(kept.node, len(raw))
        raw = canonical(f"{kept.type}_Request", raw)
        call = Call(
            kept.service, kept.type, kept.node, raw, recorder.now, requested_by_course=kept.from_course
        )
        there = [] if number < 0 else self.servers(kept.service)
        call.lost = not there
        recorder.recording.calls.append(call)
        request = kept.requests[number] = number, [call]
        for server in there:
            server._sim.inbox.append(request)

    def taken(self, service: Any, node: Any, number: int, request: Any) -> Call:
        """A service took a request; gives the call that goes on with it."""
        recorder, type_ = self._recorder, type_name(service.srv_type)
        raw = canonical(f"{type_}_Request", encode(request))
        calls = self.sent(service, number, raw)
        call = calls[0] if calls and not calls[0].server else None
        if call is None:  # another server has this request too, or it was sent past rclpy's clients
            first = calls[0] if calls else Call("", "", "", b"", None)
            call = Call(
                service._sim.service,
                type_,
                first.client,
                raw,
                first.requested,
                requested_by_course=first.requested_by_course,
            )
            calls.append(call)
            if recorder.open:
                recorder.recording.calls.append(call)
        if recorder.open:
            call.server, call.taken = recorder.name_of(node), recorder.now
            call.served_by_course = service._sim.from_course
        return call

    def services_with_requests(self) -> list[Any]:
        """Services with requests in their queues."""
        known = (service() for services in self._services.values() for service in services)
        return [found for found in known if found is not None and found._sim.inbox and alive(found.handle)]

    def sent(self, service: Any, number: int, raw: bytes) -> list[Call]:
        """The calls of a request that a service's queue gave out; [] for one sent past rclpy's clients."""
        return _take(service._sim.inbox, number, raw)

    @contextlib.contextmanager
    def answering(self, call: Call) -> Iterator[None]:
        """For the time in which a service's callback runs and its response is sent."""
        try:
            yield
        except Exception as error:
            if self._recorder.open:
                call.raised = type(error).__name__
            raise

    def answered(self, call: Call, raw: bytes) -> None:
        """A service sent its response."""
        recorder = self._recorder
        if recorder.open:
            recorder.count(call.server, len(raw))
            call.raw_response, call.answered = canonical(f"{call.type}_Response", raw), recorder.now

    def received(self, client: Any, number: int) -> None:
        """A client's future got the first response to a request."""
        kept: ClientRecord | None = client.__dict__.get("_sim")
        _, calls = kept.requests.pop(number, (number, [])) if kept is not None else (number, [])
        answered = [call for call in calls if call.answered is not None]
        if answered and self._recorder.open:
            min(answered, key=lambda call: call.answered).received = self._recorder.now


def alive(handle: Any) -> bool:
    """Whether what rclpy has this handle for was not destroyed yet."""
    try:
        with handle:
            return True
    except InvalidHandle:
        return False


def _take(inbox: deque[Request], number: int, raw: bytes) -> list[Call]:
    """The calls of the oldest request of this number, with these bytes if there is one; [] for none."""
    alike = [request for request in inbox if request[0] == number]
    if not alike:
        return []
    request = next((request for request in alike if request[1][0].raw_request == raw), alike[0])
    while inbox.popleft() is not request:
        pass  # older ones were lost
    return request[1]
