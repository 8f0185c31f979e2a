"""Records the calls of services: client, server, request, response, and their times."""

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
from sim.ros.recorder.records import CLIENT, SERVICE, ClientRecord, Request, ServiceRecord


class Calls:
    """The calls of one run.

    The client of a request that a server takes is unknown: rclpy hides that part of its header. But
    requests arrive in the order in which they were sent. So each service has an inbox, which drops what its
    queue drops, and what is taken is looked up there.
    """

    def __init__(self, recorder: RecorderBase) -> None:
        self._recorder = recorder
        self._services: dict[str, list[weakref.ref[Any]]] = defaultdict(list)
        self._lost_number, self._losing = 0, False

    def client_created(self, client: Any, node: Any, name: str) -> None:
        """A node created a client of the service of this resolved name."""
        fields = {"service": name, "type": type_name(client.srv_type), "node": self._recorder.name_of(node)}
        CLIENT.attach(client, ClientRecord(*self._recorder.creator(), **fields))

    def service_created(self, service: Any) -> None:
        """A node created a service: from now on requests reach it."""
        profile = service.qos_profile
        keeps_last = profile.history is HistoryPolicy.KEEP_LAST
        inbox: deque[Request] = deque(maxlen=max(profile.depth, 1) if keeps_last else None)
        record = ServiceRecord(*self._recorder.creator(), service=service.service_name, inbox=inbox)
        SERVICE.attach(service, record)
        self._services[service.service_name].append(weakref.ref(service))

    def servers(self, service: str) -> list[Any]:
        """The services of this resolved name that exist."""
        made = (known() for known in self._services[service])
        return [server for server in made if server is not None and alive(server.handle)]

    def discovered(self, client: Any) -> bool:
        """Return whether a request of a client would reach a server, if there is one."""
        record = CLIENT.of(client)
        there = [SERVICE.of(server) for server in self.servers(record.service)]
        return record.reaches(there, self._recorder.scheduler.now)

    @contextlib.contextmanager
    def sending(self, discovered: bool) -> Iterator[None]:
        """A request or a goal is sent in this block; it is lost if no server was discovered."""
        self._losing = not discovered
        try:
            yield
        finally:
            self._losing = False

    def lost_request_number(self) -> int | None:
        """The number, below 0, of a request that reaches no server; None if requests are sent now."""
        if not self._losing:
            return None
        self._lost_number -= 1
        return self._lost_number

    def request_sent(self, client: Any, number: int, raw: bytes) -> None:
        """A client sent a request; one of a number below 0 gets lost."""
        recorder = self._recorder
        if not recorder.open:
            return
        record = CLIENT.of(client)
        recorder.count(record.node, len(raw))
        raw = canonical(f"{record.type}_Request", raw)
        about = record.service, record.type, record.node, raw, recorder.now
        call = Call(*about, requested_by_course=record.from_course)
        there = [] if number < 0 else self.servers(record.service)
        call.lost = not there
        recorder.recording.calls.append(call)
        request = record.requests[number] = number, [call]
        for server in there:
            SERVICE.of(server).inbox.append(request)

    def request_taken(self, service: Any, node: Any, number: int, request: Any) -> Call:
        """A service took a request; returns the call that it belongs to."""
        recorder, type_ = self._recorder, type_name(service.srv_type)
        raw = canonical(f"{type_}_Request", encode(request))
        calls = self.calls_of(service, number, raw)
        call = calls[0] if calls and not calls[0].server else None
        if call is None:  # another server has this request too, or no rclpy Client sent it
            first = calls[0] if calls else Call("", "", "", b"", None)
            call = Call(
                SERVICE.of(service).service,
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
            call.served_by_course = SERVICE.of(service).from_course
        return call

    def services_with_requests(self) -> list[Any]:
        """Services with requests in their queues."""
        known = (service() for services in self._services.values() for service in services)
        there = [service for service in known if service is not None and SERVICE.of(service).inbox]
        return [service for service in there if alive(service.handle)]

    def calls_of(self, service: Any, number: int, raw: bytes) -> list[Call]:
        """The calls of a request that a service has taken; [] for one that no rclpy Client sent."""
        return _take(SERVICE.of(service).inbox, number, raw)

    @contextlib.contextmanager
    def answering(self, call: Call) -> Iterator[None]:
        """A service's callback runs and its response is sent in this block."""
        try:
            yield
        except Exception as error:
            if self._recorder.open:
                call.raised = type(error).__name__
            raise

    def response_sent(self, call: Call, raw: bytes) -> None:
        """A service sent its response."""
        recorder = self._recorder
        if recorder.open:
            recorder.count(call.server, len(raw))
            call.raw_response, call.answered = canonical(f"{call.type}_Response", raw), recorder.now

    def response_received(self, client: Any, number: int) -> None:
        """A client's future got the first response to a request."""
        record = CLIENT.find(client)
        _, calls = record.requests.pop(number, (number, [])) if record is not None else (number, [])
        answered = [call for call in calls if call.answered is not None]
        if answered and self._recorder.open:
            min(answered, key=lambda call: call.answered).received = self._recorder.now


def alive(handle: Any) -> bool:
    """Return whether the object of rclpy that has this handle was not destroyed yet."""
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
