"""The content of a graph plot: boxes, arrows between them, and the reasons for missing connections."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from sim.evidence import Recording, rate, stamps
from sim.evidence.connections import SIDES, Missing, missing

Key = tuple[str, str]  # kind and name
LIFECYCLE_SERVICES = "lifecycle_msgs/"  # type prefix of services that every lifecycle node has
NODES, NAMES, ARROWS, REASONS = 32, 40, 160, 12  # limits; names per kind; missing connections come first
CHARACTERS, ITEMS = 44, 12  # limits of a name and of a list


class GraphBox(NamedTuple):
    """One box of the diagram."""

    kind: str  # node, topic, service, action, or rest: names that a node offers and no node uses
    lines: tuple[str, ...]
    from_course: bool = False  # a node of the course, not of the student


class GraphArrow(NamedTuple):
    """A connection, in the direction of messages or requests. gap: the number of its reason if missing."""

    begin: Key
    end: Key
    gap: int = 0


@dataclass
class GraphDiagram:
    """The boxes and arrows of a graph. `text` has the same as text."""

    boxes: dict[Key, GraphBox] = field(default_factory=dict)
    arrows: dict[tuple[Key, Key], GraphArrow] = field(default_factory=dict)
    reasons: list[str] = field(default_factory=list)
    rows: list[str] = field(default_factory=list)
    omitted: str = ""  # a sentence on what was left out of a large graph

    @property
    def text(self) -> str:
        """A line for each topic, service and action, then the missing connections with their reasons."""
        gaps = [f"{number}. {reason}" for number, reason in enumerate(self.reasons, 1)]
        missing_ones = ["Missing:", *gaps] if gaps else []
        return "\n".join([*self.rows, *missing_ones, *filter(None, [self.omitted])])

    def add_arrow(self, begin: Key, end: Key, gap: int = 0) -> None:
        """Add an arrow; a missing connection replaces an existing one between the same boxes."""
        if gap or (begin, end) not in self.arrows:
            self.arrows[begin, end] = GraphArrow(begin, end, gap)


def graph_diagram(recording: Recording, *, counted: bool = True) -> GraphDiagram:
    """The diagram of a recording's graph; of a very large graph a part, with missing connections first.

    counted: with rates and numbers of messages, which takes a pass over all messages.
    """
    return _DiagramBuilder(recording, counted).diagram


class _DiagramBuilder:
    """Builds the diagram of one recording."""

    def __init__(self, recording: Recording, counted: bool) -> None:
        self.diagram, self.recording, self.counted = GraphDiagram(), recording, counted
        self.unused: dict[str, list[str]] = {}  # by node, the names that it offers and no node uses
        gaps = [gap for gap in missing(recording.graph) if not gap.idle and not _is_hidden(gap.wanted.node)]
        reasons = list(dict.fromkeys(gap.reason for gap in gaps))
        self.diagram.reasons = reasons[:REASONS]
        self.gaps = [gap for gap in gaps if gap.reason in self.diagram.reasons]
        at_gaps = [end for gap in self.gaps for end in (gap.wanted, gap.given) if end is not None]
        self.first = {end.name for end in at_gaps}
        nodes = [node for node in dict.fromkeys(recording.graph.nodes) if not _is_hidden(node)]
        shown = sorted(nodes, key=lambda node: node not in {end.node for end in at_gaps})[:NODES]
        for node in (node for node in nodes if node in shown):
            box = GraphBox("node", (_short(node),), recording.is_course_node(node))
            self.diagram.boxes["node", node] = box
        names = sum(self.add_kind(*sides) for sides in SIDES)
        for node in (node for node in self.unused if node in shown):
            key = "rest", node
            self.diagram.boxes[key] = GraphBox("rest", tuple(_truncated(self.unused[node])))
            self.diagram.add_arrow(("node", node), key)
        self.note_omissions(len(nodes) - len(shown), names, len(reasons) - len(self.diagram.reasons))

    def add_kind(self, offering: str, requesting: str, what: str) -> int:
        """Add all topics, or all services, or all actions; returns how many are omitted."""
        gaps = [gap for gap in self.gaps if gap.what == what]
        suggested = {gap.given.name for gap in gaps if gap.given is not None}
        kinds = offering, requesting
        ends = [end for kind in kinds for end in self.recording.graph.ends(kind)]
        names = {end.name for end in ends if ("node", end.node) in self.diagram.boxes}
        names -= {end.name for end in ends if end.type.startswith(LIFECYCLE_SERVICES)}
        chosen = sorted(sorted(names), key=lambda name: name not in self.first)[:NAMES]
        for name in sorted(chosen):
            offerers, requesters = (self.nodes(kind, name) for kind in kinds)
            traffic = self.traffic(what, name)
            self.diagram.rows.append(_row(what, name, traffic, offerers, requesters))
            if requesters or name in suggested:
                self.diagram.boxes[what, name] = GraphBox(what, (_short(name), traffic))
                self.connect(what, name, offerers, requesters)
            else:
                for node in offerers:
                    line = f"{_short(name)}  {traffic if what == 'topic' else what}"
                    self.unused.setdefault(node, []).append(line.rstrip())
        for gap in gaps:
            self.add_missing(gap, offering)
        return len(names) - len(chosen)

    def nodes(self, kind: str, name: str) -> list[str]:
        """The nodes with an end of this kind and name, in the diagram or not."""
        nodes = dict.fromkeys(end.node for end in self.recording.graph.ends(kind, name))
        return [node for node in nodes if not _is_hidden(node)]

    def connect(self, what: str, name: str, offerers: list[str], requesters: list[str]) -> None:
        """Add arrows between nodes and a topic, service or action."""
        for offers, node in [*((True, one) for one in offerers), *((False, one) for one in requesters)]:
            ends = ("node", node), (what, name)
            if ends[0] in self.diagram.boxes and len(self.diagram.arrows) < ARROWS:
                # messages go from the offering end, requests to it
                self.diagram.add_arrow(*(ends if offers == (what == "topic") else ends[::-1]))

    def add_missing(self, gap: Missing, offering: str) -> None:
        """Add the arrow of a missing connection: at the requesting end, if no other end connects to it."""
        number = self.diagram.reasons.index(gap.reason) + 1
        box, wanted = (gap.what, gap.wanted.name), ("node", gap.wanted.node)
        if gap.given is not None and gap.given.name != gap.wanted.name:  # similar names
            self.add_missing_arrow(gap, (gap.what, gap.given.name), box, number)
        ends = self.recording.graph.ends(offering, gap.wanted.name)
        others = [end for end in ends if end != gap.given]
        if gap.given is not None and gap.given in ends and others:
            self.add_missing_arrow(gap, ("node", gap.given.node), box, number)
        else:
            self.add_missing_arrow(gap, box, wanted, number)

    def add_missing_arrow(self, gap: Missing, offering: Key, requesting: Key, number: int) -> None:
        """Add one arrow of a missing connection if both of its boxes are in the diagram."""
        if {offering, requesting} <= self.diagram.boxes.keys():
            ends = (offering, requesting) if gap.what == "topic" else (requesting, offering)
            self.diagram.add_arrow(*ends, number)

    def traffic(self, what: str, name: str) -> str:
        """The rate or the number of messages, calls or goals."""
        if not self.counted:
            return "" if what == "topic" else what
        if what == "service":
            return _count(len(self.recording.calls_of(name)), "service", "call")
        if what == "action":
            return _count(len(self.recording.goals_of(name)), "action", "goal")
        moments = stamps(self.recording.messages(name))
        hertz = rate(moments)
        return f"{hertz:.3g} Hz" if hertz else f"{len(moments)} message{'s' * (len(moments) != 1)}"

    def note_omissions(self, nodes: int, names: int, reasons: int) -> None:
        """Set the sentence on what is omitted, if anything is."""
        counts = {"nodes": nodes, "topics, services and actions": names, "missing connections": reasons}
        omitted = [f"{count} {what}" for what, count in counts.items() if count]
        self.diagram.omitted = f"Not shown: {', '.join(omitted)}." if omitted else ""


def _count(number: int, what: str, noun: str) -> str:
    return f"{what}, {number} {noun}{'s' * (number != 1)}"


def _is_hidden(node: str) -> bool:
    return node.rsplit("/", 1)[-1].startswith("_")


def _short(name: str) -> str:
    half = CHARACTERS // 2
    return name if len(name) <= CHARACTERS else f"{name[:half]}…{name[-half:]}"


def _truncated(items: list[str]) -> list[str]:
    more = [f"and {len(items) - ITEMS + 1} more"] if len(items) > ITEMS else []
    return [*items[: ITEMS - len(more)], *more]


def _row(what: str, name: str, traffic: str, offerers: list[str], requesters: list[str]) -> str:
    ends = [", ".join(_truncated(nodes)) or "no node" for nodes in (offerers, requesters)]
    ends = ends if what == "topic" else ends[::-1]
    kind = f"{what} " if what == "topic" else ""
    return f"{kind}{name}{traffic and f' ({traffic})'}: {ends[0]} -> {ends[1]}"


def connected_first(diagram: GraphDiagram) -> Iterator[tuple[Key, GraphBox]]:
    """All boxes, those without arrows last."""
    connected = {key for pair in diagram.arrows for key in pair}
    yield from sorted(diagram.boxes.items(), key=lambda item: item[0] not in connected)
