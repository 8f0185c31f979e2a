"""Numbers shown beside a live picture: the robot's state, and the messages of one selected topic."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from sim.evidence.message_text import TopicMessage, decoded, long_lists, numbers_to_plot, text_lines
from sim.evidence.readings import readings
from sim.ros.session import Session
from sim.world import Contact, Scene, World

PLOT_PERIOD, MAX_POINTS = 10.0, 400  # s of simulated time, and points of a topic's plot
MAX_CURVES = 2
ORDER = "warehouse_msgs/msg/Order"
CONTACT_SHOWN = 2.0  # s of simulated time; a contact may be shorter than the time between two states


class Telemetry:
    """Follows the messages of a run; each is read once."""

    def __init__(self) -> None:
        self.topic = ""  # the selected one
        self._next = 0  # index in a recording
        self._newest: dict[str, TopicMessage] = {}
        self._orders: list[Any] = []  # messages of a warehouse's desk
        self._recent: deque[TopicMessage] = deque(maxlen=MAX_POINTS)

    def select(self, topic: str) -> None:
        """Show this topic from now on; "" for none."""
        self.topic = topic
        self._recent.clear()

    def update(self, session: Session) -> dict[str, Any]:
        """Work like `values`, of all that a session has recorded."""
        recording = session.recording
        for message in recording.published[self._next :]:
            self.add(message)
        self._next = len(recording.published)
        scene = None if session.truth is None else session.truth.scene
        return self.values(recording.world, scene, recording.contacts, recording.topics)

    def add(self, message: TopicMessage) -> None:
        """Take note of a message."""
        self._newest[message.topic] = message
        if message.type == ORDER and (order := decoded(message)) is not None:
            self._orders.append(order)
        if message.topic == self.topic:
            self._recent.append(message)

    def values(
        self,
        world: World | None,
        scene: Scene | None,
        contacts: Sequence[Contact],
        topics: Mapping[str, str],
    ) -> dict[str, Any]:
        """numbers: pairs of label and text. touching: whether the robot is in contact.

        topic: the selected topic's newest message and plot, or None. topics: the type of each topic, by name.
        """
        pose = ranges = None
        if scene is not None and world is not None:
            names = [body.name for body in scene.bodies]
            if world.driven_body in names:
                pose = scene.poses[names.index(world.driven_body)]
            ranges = None if scene.last_scan is None else scene.last_scan.ranges
        numbers = list(readings(world, pose, self._message, ranges, contacts, self._orders))
        touching = scene is not None and self._touches(scene.time, contacts)
        return {"numbers": numbers, "touching": touching, "topic": self._topic(topics.get(self.topic))}

    def _touches(self, now: float, contacts: Sequence[Contact]) -> bool:
        """Return whether the robot touches something, or has just done so."""
        bumper = self._message("/bumper", "std_msgs/msg/Bool")
        recent = bool(contacts) and now - contacts[-1].stamp < CONTACT_SHOWN
        return recent or (bumper is not None and bumper.data)

    def _message(self, topic: str, *kinds: str) -> Any:
        item = self._newest.get(topic)
        return decoded(item) if item is not None and item.type in kinds else None

    def _topic(self, kind: str | None) -> dict[str, Any] | None:
        if kind is None:
            return None
        item = self._newest.get(self.topic)
        message = decoded(item) if item is not None else None
        shown: dict[str, Any] = {"name": self.topic, "type": kind}
        shown |= {"text": "No message yet.", "stamp": None, "curves": []}
        if item is not None and message is not None:
            shown |= {"text": "\n".join(text_lines(message)), "stamp": item.stamp}
            shown["curves"] = list(self._curves(message, item.stamp))
        return shown

    def _curves(self, message: Any, now: float) -> Iterator[dict[str, Any]]:
        """The curves to plot: the numbers of a long list, or single numbers over time."""
        rows = next(long_lists(message), None)
        if rows is not None:
            name, values = rows
            step = max(1, len(values) // MAX_POINTS)
            points = [[i, float(v)] for i, v in enumerate(values) if i % step == 0 and math.isfinite(v)]
            yield {"name": name, "along": "item", "points": points}
            return
        while self._recent and self._recent[0].stamp < now - PLOT_PERIOD:
            self._recent.popleft()
        seen = [(item.stamp, dict(numbers_to_plot(decoded(item)))) for item in self._recent]
        fields = dict.fromkeys(name for _, values in seen for name in values)
        different = {name: {values[name] for _, values in seen if name in values} for name in fields}
        changing = [name for name, values in different.items() if len(values) > 1]
        for name in (changing or list(fields))[:MAX_CURVES]:
            points = [
                [stamp, values[name]] for stamp, values in seen if math.isfinite(values.get(name, math.nan))
            ]
            yield {"name": name, "along": "s", "points": points}
