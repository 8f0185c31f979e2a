"""What a picture of a graph shows: boxes, arrows between them, and the reasons for those that are missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from sim.evidence import Recording, rate, stamps
from sim.evidence.connections import SIDES, Missing, missing

Key = tuple[str, str]  # kind and name
MACHINERY = "lifecycle_msgs/"  # services that every node with a lifecycle has
NODES, NAMES, ARROWS, REASONS = 32, 40, 160, 12  # so many at most; names of each kind; what is missing first
CHARACTERS, ITEMS = 44, 12  # of a name; in a list


class Box(NamedTuple):
    """One thing in the picture."""

    kind: str  # node, topic, service, action, or rest: what nobody hears or asks
    lines: tuple[str, ...]
    from_course: bool = False  # a node that is not the student's


class Arrow(NamedTuple):
    """A connection, the way that messages or requests go; gap: the number of its reason, if it's missing."""

    begin: Key
    end: Key
    gap: int = 0


@dataclass
class Wiring:
    """All that is drawn of one graph. The same in words is `text`."""

    boxes: dict[Key, Box] = field(default_factory=dict)
    arrows: dict[tuple[Key, Key], Arrow] = field(default_factory=dict)
    reasons: list[str] = field(default_factory=list)
    rows: list[str] = field(default_factory=list)
    left_out: str = ""  # a sentence on what is too much for a picture

    @property
    def text(self) -> str:
        """The graph in words: a line for each topic, service and action, then what is missing and why."""
        gaps = [f"{number}. {reason}" for number, reason in enumerate(self.reasons, 1)]
        missing_ones = ["Missing:", *gaps] if gaps else []
        return "\n".join([*self.rows, *missing_ones, *filter(None, [self.left_out])])

    def arrow(self, begin: Key, end: Key, gap: int = 0) -> None:
        """Add an arrow; one that is missing takes the place of one that is not."""
        if gap or (begin, end) not in self.arrows:
            self.arrows[begin, end] = Arrow(begin, end, gap)


def wiring(recording: Recording, *, counted: bool = True) -> Wiring:
    """What is drawn of a recording's graph; of a very large one a part, with all that is missing first.

    counted: with rates and numbers, for which all messages are gone through.
    """
    return _Drawing(recording, counted).made


class _Drawing:
    """Puts the wiring of one recording together."""

    def __init__(self, recording: Recording, counted: bool) -> None:
        self.made, self.recording, self.counted = Wiring(), recording, counted
        self.rest: dict[str, list[str]] = {}  # of each node, what nobody takes
        gaps = [gap for gap in missing(recording.graph) if not gap.idle and not _is_hidden(gap.wanted.node)]
        reasons = list(dict.fromkeys(gap.reason for gap in gaps))
        self.made.reasons = reasons[:REASONS]
        self.gaps = [gap for gap in gaps if gap.reason in self.made.reasons]
        at_gaps = [end for gap in self.gaps for end in (gap.wanted, gap.given) if end is not None]
        self.first = {end.name for end in at_gaps}
        nodes = [node for node in dict.fromkeys(recording.graph.nodes) if not _is_hidden(node)]
        shown = sorted(nodes, key=lambda node: node not in {end.node for end in at_gaps})[:NODES]
        for node in (node for node in nodes if node in shown):
            self.made.boxes["node", node] = Box("node", (_short(node),), recording.is_course_node(node))
        names = sum(self.side(*sides) for sides in SIDES)
        for node in (node for node in self.rest if node in shown):
            key = "rest", node
            self.made.boxes[key] = Box("rest", tuple(_first(self.rest[node])))
            self.made.arrow(("node", node), key)
        self.tell_of_the_rest(len(nodes) - len(shown), names, len(reasons) - len(self.made.reasons))

    def side(self, giving: str, taking: str, what: str) -> int:
        """Draw all topics, or all services, or all actions; how many of them are left out."""
        gaps = [gap for gap in self.gaps if gap.what == what]
        meant = {gap.given.name for gap in gaps if gap.given is not None}
        kinds = giving, taking
        ends = [end for kind in kinds for end in self.recording.graph.ends(kind)]
        names = {end.name for end in ends if ("node", end.node) in self.made.boxes}
        names -= {end.name for end in ends if end.type.startswith(MACHINERY)}
        chosen = sorted(sorted(names), key=lambda name: name not in self.first)[:NAMES]
        for name in sorted(chosen):
            givers, takers = (self.nodes(kind, name) for kind in kinds)
            much = self.much(what, name)
            self.made.rows.append(_row(what, name, much, givers, takers))
            if takers or name in meant:
                self.made.boxes[what, name] = Box(what, (_short(name), much))
                self.connect(what, name, givers, takers)
            else:
                for giver in givers:
                    line = f"{_short(name)}  {much if what == 'topic' else what}"
                    self.rest.setdefault(giver, []).append(line.rstrip())
        for gap in gaps:
            self.mark(gap, giving)
        return len(names) - len(chosen)

    def nodes(self, kind: str, name: str) -> list[str]:
        """The nodes that have such an end, drawn or not."""
        nodes = dict.fromkeys(end.node for end in self.recording.graph.ends(kind, name))
        return [node for node in nodes if not _is_hidden(node)]

    def connect(self, what: str, name: str, givers: list[str], takers: list[str]) -> None:
        """Arrows between nodes and what they share."""
        for given, node in [*((True, one) for one in givers), *((False, one) for one in takers)]:
            ends = ("node", node), (what, name)
            if ends[0] in self.made.boxes and len(self.made.arrows) < ARROWS:
                self.made.arrow(*(ends if given == (what == "topic") else ends[::-1]))  # requests go back

    def mark(self, gap: Missing, giving: str) -> None:
        """Make the arrow red that shows a gap: at the end that gets nothing, if it gets nothing at all."""
        number = self.made.reasons.index(gap.reason) + 1
        box, wanted = (gap.what, gap.wanted.name), ("node", gap.wanted.node)
        if gap.given is not None and gap.given.name != gap.wanted.name:  # names that are nearly equal
            self.red(gap, (gap.what, gap.given.name), box, number)
        givers = self.recording.graph.ends(giving, gap.wanted.name)
        others = [end for end in givers if end != gap.given]
        if gap.given is not None and gap.given in givers and others:
            self.red(gap, ("node", gap.given.node), box, number)
        else:
            self.red(gap, box, wanted, number)

    def red(self, gap: Missing, giver: Key, taker: Key, number: int) -> None:
        """A missing arrow, the way that messages or requests would go, where both of its boxes are drawn."""
        if {giver, taker} <= self.made.boxes.keys():
            self.made.arrow(*((giver, taker) if gap.what == "topic" else (taker, giver)), number)

    def much(self, what: str, name: str) -> str:
        """How much goes on there."""
        if not self.counted:
            return "" if what == "topic" else what
        if what == "service":
            return _count(len(self.recording.calls_of(name)), "service", "call")
        if what == "action":
            return _count(len(self.recording.goals_of(name)), "action", "goal")
        moments = stamps(self.recording.messages(name))
        hertz = rate(moments)
        return f"{hertz:.3g} Hz" if hertz else f"{len(moments)} message{'s' * (len(moments) != 1)}"

    def tell_of_the_rest(self, nodes: int, names: int, reasons: int) -> None:
        """Say what is left out, if anything is."""
        counts = {"nodes": nodes, "topics, services and actions": names, "missing connections": reasons}
        told = [f"{count} {what}" for what, count in counts.items() if count]
        self.made.left_out = f"Not shown: {', '.join(told)}." if told else ""


def _count(number: int, what: str, noun: str) -> str:
    return f"{what}, {number} {noun}{'s' * (number != 1)}"


def _is_hidden(node: str) -> bool:
    return node.rsplit("/", 1)[-1].startswith("_")


def _short(name: str) -> str:
    half = CHARACTERS // 2
    return name if len(name) <= CHARACTERS else f"{name[:half]}…{name[-half:]}"


def _first(items: list[str]) -> list[str]:
    more = [f"and {len(items) - ITEMS + 1} more"] if len(items) > ITEMS else []
    return [*items[: ITEMS - len(more)], *more]


def _row(what: str, name: str, much: str, givers: list[str], takers: list[str]) -> str:
    ends = [", ".join(_first(nodes)) or "nobody" for nodes in (givers, takers)]
    ends = ends if what == "topic" else ends[::-1]
    kind = f"{what} " if what == "topic" else ""
    return f"{kind}{name}{much and f' ({much})'}: {ends[0]} -> {ends[1]}"


def columns(made: Wiring) -> Iterator[tuple[Key, Box]]:
    """All boxes, those without any arrow last."""
    joined = {key for pair in made.arrows for key in pair}
    yield from sorted(made.boxes.items(), key=lambda item: item[0] not in joined)
