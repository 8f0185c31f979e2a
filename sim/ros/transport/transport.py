"""The transport of one run: topics, the network of services and actions, and what is scheduled on it."""

from __future__ import annotations

from collections.abc import Callable

from sim.nanoseconds import Nanoseconds
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.recorder.recorder import Recorder
from sim.ros.recorder.records import ACTION, SERVICE
from sim.ros.transport.context import TransportContext
from sim.ros.transport.peer import Peer
from sim.ros.transport.service_transport import ServiceTransport
from sim.ros.transport.topics import Topics


class Transport(TransportContext):
    """All of it. services: None without a network; then the middleware carries them, at once."""

    def __init__(
        self, scheduler: Scheduler, recorder: Recorder, moment_at: Callable[[int], Nanoseconds]
    ) -> None:
        super().__init__(scheduler, recorder, moment_at)
        self.topics = Topics(self)
        self.services = None if self.links is None else ServiceTransport(self)

    def connect(self, peer: Peer) -> None:
        """Another process has nodes of this run: it learns what happens to endpoints here."""
        self.peer = peer

    def collect(self) -> bool:
        """Send on the network what services and actions have sent; whether any of it has already arrived."""
        return self.services is not None and self.services.collect()

    def request_sent(self, service: str) -> None:
        """A client has sent a request to the services of this resolved name."""
        new = False
        for server in self.recorder.calls.servers(service):
            record = SERVICE.of(server)
            new |= not record.called
            record.called = record.has_requests = True
        if new:  # executors list only services that have been called: a node has seven of its own
            self.scheduler.waiters.endpoints_changed()
        self.scheduler.wake_all()

    def sent_by_middleware(self) -> None:
        """C++ code has sent a response or a message that an endpoint of an action may have to take."""
        for endpoint in self.recorder.goals.endpoints():
            ACTION.of(endpoint).has_news = True
        self.scheduler.wake_all()
