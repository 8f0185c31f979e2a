"""Which ready callback an executor takes first, in a run in another order than the usual one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any, NamedTuple

from sim.nanoseconds import Nanoseconds
from sim.order import ANY, HOST, Draw
from sim.ros.fibers.choices import FIRST, USUAL, Choices
from sim.ros.recorder.records import SERVICE
from sim.ros.recorder.running import callback_name
from sim.ros.transport.reader import READER

TIMERS = "timers"


class Place(NamedTuple):
    """One entity of an executor, with its place in the usual order, and what is drawn for it."""

    index: int
    entry: Any  # as of ReadyScan
    label: str
    rank: int
    draw: Draw | None


def kind_of(entry: Any) -> str:
    """The kind of an entity: timer, subscription, client, service ..."""
    return entry[0].__name__.removeprefix("_")


def label_of(entry: Any) -> str:
    """Return how an entity is called: a topic's or service's name, or a timer's callback."""
    entity = entry[1]
    for name in ("topic_name", "srv_name", "service_name", "_action_name"):
        found = getattr(entity, name, None)
        if isinstance(found, str):
            return found
    return callback_name(getattr(entity, "callback", type(entity)))


def may_be_ready(entry: Any) -> bool:
    """Return whether an entity has work, as far as that can be seen without taking it."""
    kind, entity = kind_of(entry), entry[1]
    if kind == "timer":
        return entity.handle.is_timer_ready()
    if kind == "subscription":
        return bool(READER.of(entity).queue)
    if kind == "service":
        return SERVICE.of(entity).has_requests
    return kind != "guard_condition" or entity._executor_triggered


class ReadyOrder:
    """The order in which one executor checks its entities; one draw for each entity and time."""

    def __init__(self, choices: Choices) -> None:
        self._choices = choices
        self._labels: tuple[Any, list[str]] = (None, [])
        self._places: tuple[Any, Nanoseconds, list[Place]] = (None, -1, [])

    def arranged(self, entries: list[Any], now: Nanoseconds) -> list[Any]:
        """These entities in the order of this time."""
        if self._places[0] is not entries or self._places[1] != now:
            places = [self._place(index, entry, now) for index, entry in enumerate(self._labeled(entries))]
            self._places = entries, now, sorted(places, key=lambda place: place.rank)
        return [place.entry for place in self._places[2]]

    def _labeled(self, entries: list[Any]) -> Iterator[tuple[Any, str]]:
        if self._labels[0] is not entries:
            count: Counter[str] = Counter()
            labels = []
            for entry in entries:
                label = f"{kind_of(entry)} {label_of(entry)} of {entry[2].get_fully_qualified_name()}"
                count[label] += 1
                labels.append(f"{label} {count[label]}")
            self._labels = entries, labels
        return zip(entries, self._labels[1], strict=True)

    def _place(self, index: int, labeled: tuple[Any, str], now: Nanoseconds) -> Place:
        entry, label = labeled
        name = self._name_of_choice(entry, label)
        if name is None:
            return Place(index, entry, label, USUAL, None)
        draw = self._choices.order.draw("callback", now, name)
        return Place(index, entry, label, self._choices.rank(draw, self._choices.order.intensity), draw)

    def _name_of_choice(self, entry: Any, label: str) -> str | None:
        """By which choice an entity may come earlier or later; None if rclpy always takes it in its place.

        Timers of one executor keep their order, which rclpy always has, except at the level *any*. On one
        machine what has arrived is taken in a fixed order, too, and only timers are earlier or later.
        """
        level = self._choices.order.level
        if level == ANY:
            return label
        if kind_of(entry) == "timer":
            return f"{TIMERS} of {entry[2].get_fully_qualified_name()}"
        return None if level == HOST else label

    def note(self, entity: Any) -> None:
        """This entity is taken: of those that come after it now, what is ready is taken later than usual."""
        places = self._places[2]
        index = next((i for i, place in enumerate(places) if place.entry[1] is entity), len(places))
        for later in places[index + 1 :]:
            place = places[index]
            if later.index < place.index and may_be_ready(later.entry):
                chosen = place if place.rank == FIRST else later
                if chosen.draw is not None:
                    node = place.entry[2].get_fully_qualified_name()
                    text = f"{node} takes {label_of(place.entry)} before {label_of(later.entry)}"
                    self._choices.note_departure(chosen.draw, node, "callback", text)
