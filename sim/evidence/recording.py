"""`Recording`: the record of one run, and what can be computed from it."""

from __future__ import annotations

import bisect
import functools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

from sim.evidence.arrived import arrived
from sim.evidence.by_topic import ByTopic
from sim.evidence.digest import digest_of
from sim.evidence.exchanges import Call, Goal, is_node_service
from sim.evidence.failure import failure_of
from sim.evidence.rows import (
    INFRASTRUCTURE_TOPICS,
    Message,
    Pose,
    Seconds,
)
from sim.evidence.run_data import RunData
from sim.nanoseconds import SECOND
from sim.order import Order
from sim.world import Body


class Recording(RunData):
    """The record of one run. `until` sees it while it grows; checks see it when it is complete."""

    # What `replay` returns. The package `sim` sets it, so that evidence does not import the view.
    player: ClassVar[Callable[..., Any]]

    def during(self, begin: Seconds, end: Seconds = math.inf) -> Recording:
        """Return what happened from `begin` on and before `end`, as a recording for any measure.

        Calls and goals count by when they were requested, callbacks by when they began; the graph, what
        pens drew and what became of messages on the network stay whole.
        """

        def inside(items: Iterable[Any], stamp: Callable[[Any], Seconds | None]) -> list[Any]:
            return [item for item in items if (at := stamp(item)) is not None and begin <= at < end]

        def stamped(items: Iterable[Any]) -> list[Any]:
            return inside(items, lambda item: item[0])

        return replace(
            self,
            begin=max(begin, self.begin),
            stamp=min(end, self.stamp),
            ended=self.ended._replace(stamp=min(end, self.ended.stamp)),
            published=stamped(self.published),
            calls=inside(self.calls, lambda call: call.requested),
            goals=inside(self.goals, lambda goal: goal.requested),
            path=stamped(self.path),
            tracks={name: stamped(poses) for name, poses in self.tracks.items()},
            contacts=stamped(self.contacts),
            other_contacts={name: stamped(touches) for name, touches in self.other_contacts.items()},
            logs=stamped(self.logs),
            errors=stamped(self.errors),
            callbacks=stamped(self.callbacks),
            busy_loops=stamped(self.busy_loops),
            undelivered=stamped(self.undelivered),
            prints=stamped(self.prints),
        )

    def pose_at(self, stamp: Seconds) -> Pose:
        """Return where the robot really was at that time: its first pose from then on, or its last.

        Raises ValueError for a run without a robot.
        """
        if not self.path:
            raise ValueError("this run has no robot: give the exercise a world")
        index = bisect.bisect_left(self.path, stamp - 1e-6, key=lambda pose: pose.stamp)
        return self.path[min(index, len(self.path) - 1)]

    @property
    def started_at(self) -> Seconds:
        """Return when the last program under test started: 0, except in an order in which one is late."""
        order = Order.parse(self.order or None)
        if order is None:
            return 0.0
        # A process that is not trusted reports its starts: it can't claim more than the order allows.
        reported = max((item.stamp for item in self.departures if item.kind == "start"), default=0.0)
        return min(reported, order.all_started / SECOND)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All that moved: what the world began with, and what came later and looks like the first of that."""
        known = self.world.bodies if self.world is not None else ()
        names = {body.name for body in known}
        return (*known, *(known[0]._replace(name=name) for name in self.tracks if name not in names))

    @property
    def tip(self) -> list[Pose]:
        """Return where the far end of a machine's last link was, and which way that link pointed.

        Empty for a run without a machine that is made of links.
        """
        bodies = self.world.bodies if self.world is not None else ()
        if not bodies or any(body.kind != "link" for body in bodies):
            return []
        along = [x for x, _ in bodies[-1].outline]
        length = min(along) + max(along)  # it reaches as far behind its joint as beyond the tip
        return [
            Pose(stamp, x + length * math.cos(yaw), y + length * math.sin(yaw), yaw)
            for stamp, x, y, yaw in self.tracks.get(bodies[-1].name, [])
        ]

    def is_course_node(self, name: str) -> bool:
        """Return whether a node or logger name, such as "/pilot" or "robot1.driver", is one of the course."""
        return (name if name.startswith("/") else "/" + name.replace(".", "/")) in self.course_nodes

    def messages(self, topic: str | None = None, sender: str | None = None) -> list[Message]:
        """Messages in the order they were published: of one topic, of one node, or all but those of ROS.

        topic: resolved name with its leading slash, e.g. "/cmd_vel". sender: e.g. "/talker".
        """
        if topic is None:
            wanted = [message for message in self.published if message.topic not in INFRASTRUCTURE_TOPICS]
        else:
            wanted = self._by_topic.of(self.published, topic)
        return wanted if sender is None else [message for message in wanted if message.sender == sender]

    @functools.cached_property
    def _by_topic(self) -> ByTopic:
        return ByTopic()

    def received(self, topic: str) -> list[Message]:
        """The course's messages on a topic, with the stamps at which the nodes under test received them.

        In the usual order that is when they were sent. In another one, what was sent before the nodes had
        started, or arrives after the end, is left out.
        """
        sent = [message for message in self.messages(topic) if message.from_course]
        order = Order.parse(self.order or None)
        return sent if order is None else arrived(self, topic, sent, order, self.started_at)

    def calls_of(
        self, service: str | None = None, client: str | None = None, server: str | None = None
    ) -> list[Call]:
        """Calls in the order of their requests; of one service, or all but those that every node has.

        service: resolved name, e.g. "/add". client, server: full names of nodes, e.g. "/adder".
        """
        return [
            call
            for call in self.calls
            if (not is_node_service(call.service) if service is None else call.service == service)
            and client in (None, call.client)
            and server in (None, call.server)
        ]

    def goals_of(
        self, action: str | None = None, client: str | None = None, server: str | None = None
    ) -> list[Goal]:
        """Goals in the order they were requested; of one action, of one client or server, or all."""
        return [
            goal
            for goal in self.goals
            if action in (None, goal.action)
            and client in (None, goal.client)
            and server in (None, goal.server)
        ]

    @property
    def failure(self) -> str:
        """The first error in the user's programs, or why the run got stuck, in a line; "" if neither."""
        return failure_of(self)

    @property
    def topics(self) -> dict[str, str]:
        """Topic name to type, for every topic with a publisher, sorted by name."""
        return dict(sorted({e.name: e.type for e in self.graph.publishers()}.items()))

    @functools.cached_property
    def digest(self) -> str:
        """One hex string for the whole run: equal runs have equal digests."""
        return digest_of(self)

    def save(self, path: str | Path) -> Path:
        """Write an MCAP file: ROS's own recording format, which `ros2 bag` and Foxglove also open."""
        from sim.evidence.storage import write  # here, for its libraries take a while to import

        return write(self, Path(path))

    def save_bag(
        self,
        folder: str | Path,
        topics: str | Sequence[str] = (),
        *,
        delay: Seconds = 0.03,
        jitter: Seconds = 0.005,
        begin: Seconds = 0.0,
    ) -> str:
        """Write messages into a folder, in place of an earlier bag, as a laptop records them with `ros2 bag`.

        topics: one or several; all but ROS's own by default. delay: how long the robot's messages are on the
        way (s), more or less `jitter`. begin: when the recording begins (s): earlier messages are missing,
        and latched ones, too. Returns the folder. Raises BagError if it can't be made.
        """
        from sim.ros.bags.saving import save_bag  # here, for its libraries take a while to import

        return save_bag(self, folder, topics, delay=delay, jitter=jitter, begin=begin)

    @staticmethod
    def load(path: str | Path) -> Recording:
        """Read a file written by `save`. Raises StorageError with one clear sentence if it isn't one."""
        from sim.evidence.storage import read

        return read(Path(path), Recording)

    def replay(
        self, *, speed: float = 1.0, moments: Sequence[tuple[Seconds, str]] = (), plays: bool = False
    ) -> Any:
        """The run as a player with a scrub bar; it stays in the saved notebook and in pages made from it.

        speed: simulated seconds per second, to begin with. Raises ValueError if it isn't above 0. moments:
        stamps with a text, marked in red; it opens a second before the first of them. plays: it starts at
        once, unless the reader's system asks for reduced motion.
        """
        return type(self).player(self, speed=speed, moments=moments, plays=plays)

    def __repr__(self) -> str:
        return (
            f"<Recording of {self.stamp:g} s: {len(self.published)} messages on {len(self.topics)} topics, "
            f"{len(self.logs)} log lines, {len(self.errors)} errors, ended: {self.ended.reason}"
            f"{'; ' if self.failure else ''}{self.failure}>"
        )
