"""Numbers shown beside a live picture: the robot's state, and the messages of one selected topic."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from typing import Any

from sim.evidence import Message
from sim.evidence.message_text import decoded, long_lists, single_numbers, text_lines
from sim.evidence.readings import readings
from sim.ros.session import Session

PLOT_PERIOD, MAX_POINTS = 10.0, 400  # s of simulated time, and points of a topic's plot
MAX_CURVES = 2


class Telemetry:
    """Follows the messages of a run; each is read once."""

    def __init__(self) -> None:
        self.topic = ""  # the selected one
        self._next = 0
        self._newest: dict[str, Message] = {}
        self._recent: deque[Message] = deque(maxlen=MAX_POINTS)

    def select(self, topic: str) -> None:
        """Show this topic from now on; "" for none."""
        self.topic = topic
        self._recent.clear()

    def update(self, session: Session) -> dict[str, Any]:
        """numbers: pairs of label and text. topic: the selected topic's newest message and plot, or None."""
        messages = session.recording.published
        for message in messages[self._next :]:
            self._newest[message.topic] = message
            if message.topic == self.topic:
                self._recent.append(message)
        self._next = len(messages)
        return {"numbers": list(self._numbers(session)), "topic": self._topic(session)}

    def _numbers(self, session: Session) -> Iterator[tuple[str, str]]:
        world, truth = session.recording.world, session.truth
        pose = ranges = None
        if truth is not None and world is not None:
            names = [body.name for body in truth.scene.bodies]
            if world.driven_body in names:
                pose = truth.scene.poses[names.index(world.driven_body)]
            scan = truth.scene.last_scan
            ranges = None if scan is None else scan.ranges
        yield from readings(world, pose, self._message, ranges, session.recording.contacts)

    def _message(self, topic: str, *kinds: str) -> Any:
        item = self._newest.get(topic)
        return decoded(item) if item is not None and item.type in kinds else None

    def _topic(self, session: Session) -> dict[str, Any] | None:
        kind = session.recording.topics.get(self.topic)
        if kind is None:
            return None
        item = self._newest.get(self.topic)
        message = decoded(item) if item is not None else None
        shown = {"name": self.topic, "type": kind, "text": "No message yet.", "stamp": None, "curves": []}
        if message is not None:
            shown |= {"text": "\n".join(text_lines(message)), "stamp": item.stamp}
            shown["curves"] = list(self._curves(message, item.stamp))
        return shown

    def _curves(self, message: Any, now: float) -> Iterator[dict[str, Any]]:
        """The curves to plot: the numbers of a long list, or single numbers over time."""
        fields = dict(single_numbers(message))
        rows = next(long_lists(message), None)
        if rows is not None:
            name, values = rows
            step = max(1, len(values) // MAX_POINTS)
            points = [[i, float(v)] for i, v in enumerate(values) if i % step == 0 and math.isfinite(v)]
            yield {"name": name, "along": "item", "points": points}
            return
        while self._recent and self._recent[0].stamp < now - PLOT_PERIOD:
            self._recent.popleft()
        seen = [(item.stamp, dict(single_numbers(decoded(item)))) for item in self._recent]
        changing = [name for name in fields if len({values.get(name) for _, values in seen}) > 1]
        for name in (changing or list(fields))[:MAX_CURVES]:
            points = [
                [stamp, values[name]] for stamp, values in seen if math.isfinite(values.get(name, math.nan))
            ]
            yield {"name": name, "along": "s", "points": points}
