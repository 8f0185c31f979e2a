"""What all parts of a run's transport share."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable
from typing import Any

from sim.nanoseconds import Nanoseconds
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.recorder.recorder import Recorder
from sim.ros.transport.arrivals import Arrivals
from sim.ros.transport.event_queue import EventQueue
from sim.ros.transport.links import HostLinks
from sim.ros.transport.peer import Peer


class TransportContext:
    """The run that a transport belongs to, its scheduled events, and the network between its hosts.

    moment_at: the simulated time at a time of the wall clock, both in nanoseconds.
    """

    def __init__(
        self, scheduler: Scheduler, recorder: Recorder, moment_at: Callable[[int], Nanoseconds]
    ) -> None:
        self.scheduler, self.recorder, self.moment_at = scheduler, recorder, moment_at
        self.events = EventQueue()
        network = recorder.recording.network
        self.links = None if network is None else HostLinks(network, recorder.recording.seed)
        self.sent: Counter[str] = Counter()  # messages on each topic, except those that C++ code publishes
        self.peer: Peer | None = None
        self.elsewhere: defaultdict[str, list[Any]] = defaultdict(list)  # its subscriptions, by topic
        self.arrivals = None if scheduler.choices is None else Arrivals(scheduler.choices)
