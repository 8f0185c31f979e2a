"""What all parts of the recorder share: the recording, its limits, and the running program."""

from __future__ import annotations

from typing import Any

from sim.evidence import Recording
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.fibers.fiber import Program
from sim.ros.fibers.scheduler import Scheduler

MAX_MESSAGES_PER_INSTANT = 20_000
MAX_MESSAGES = 1_000_000  # of a run
MAX_MESSAGE_BYTES = 500_000_000  # of a run


class RecorderBase:
    """One recording, and the run that fills it. open: whether anything is still recorded."""

    def __init__(self, scheduler: Scheduler, recording: Recording) -> None:
        self.scheduler, self.recording = scheduler, recording
        self.open = True
        self.sent = 0  # messages, requests and the like of the whole run
        self.node_names: dict[int, str] = {}  # id of a node -> its fully qualified name
        self._bytes = 0
        self._instant, self._messages = -1, 0  # the last publish's time, and how many there were then

    @property
    def now(self) -> float:
        """Simulated seconds since the start of the run."""
        return self.scheduler.now / SECOND

    def creator(self) -> tuple[Nanoseconds, Program | None, bool]:
        """Of an endpoint that is created now: the time, the program, and whether it is the course's."""
        fiber = self.scheduler.current
        return self.scheduler.now, None if fiber is None else fiber.process, self.is_course_node()

    def name_of(self, node: Any) -> str:
        """Fully qualified name of a node, or of the current process for None."""
        if node is not None:
            return self.node_names.get(id(node)) or node.get_fully_qualified_name()
        fiber = self.scheduler.current
        nodes = fiber.process.nodes if fiber is not None else []
        return self.name_of(nodes[0]) if nodes else f"/{fiber.process.name}" if fiber is not None else ""

    def is_course_node(self) -> bool:
        """Return whether a program of the course is running."""
        fiber = self.scheduler.current
        return fiber is not None and fiber.process.from_course

    def count(self, sender: str, size: int) -> None:
        """A node sent a message, request or the like, of so many bytes. Raises Livelock for too many."""
        now = self.scheduler.now
        if now != self._instant:
            self._instant, self._messages = now, 0
        self._messages += 1
        if self._messages > MAX_MESSAGES_PER_INSTANT:
            self.scheduler.raise_livelock(
                f"{sender} sent {MAX_MESSAGES_PER_INSTANT} messages at t = {self.now:g} s without letting "
                "time advance"
            )
        if self.sent >= MAX_MESSAGES:
            self.scheduler.raise_livelock(
                f"the nodes sent more than {MAX_MESSAGES} messages by t = {self.now:g} s"
            )
        self._bytes += size
        if self._bytes > MAX_MESSAGE_BYTES:
            self.scheduler.raise_livelock(
                f"the nodes sent more than {MAX_MESSAGE_BYTES / 1e6:g} MB by t = {self.now:g} s"
            )
        self.sent += 1  # not before: the guard must see that code which swallows the Livelock is stuck
