"""What a picture of a graph shows: boxes, arrows between them, and the reasons for those that are missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from sim.evidence import Recording, rate, stamps
from sim.evidence.connections import SIDES, Missing, missing

Key = tuple[str, str]  # kind and name
MACHINERY = "lifecycle_msgs/"  # services that every node with a lifecycle has


class Box(NamedTuple):
    """One thing in the picture."""

    kind: str  # node, topic, service, action, or rest: what nobody hears or asks
    lines: tuple[str, ...]
    ours: bool = False  # a node that is not the student's


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

    @property
    def text(self) -> str:
        """The graph in words: a line for each topic, service and action, then what is missing and why."""
        gaps = [f"{number}. {reason}" for number, reason in enumerate(self.reasons, 1)]
        return "\n".join([*self.rows, *(["Missing:", *gaps] if gaps else [])])

    def arrow(self, begin: Key, end: Key, gap: int = 0) -> None:
        """Add an arrow; one that is missing takes the place of one that is not."""
        if gap or (begin, end) not in self.arrows:
            self.arrows[begin, end] = Arrow(begin, end, gap)


def wiring(recording: Recording) -> Wiring:
    """What is drawn of a recording's graph."""
    made, gaps = Wiring(), [gap for gap in missing(recording.graph) if not _idle(gap)]
    made.reasons = list(dict.fromkeys(gap.reason for gap in gaps))
    for node in dict.fromkeys(recording.graph.nodes):
        if not node.rsplit("/", 1)[1].startswith("_"):
            made.boxes["node", node] = Box("node", (node,), recording.is_ours(node))
    rest: dict[str, list[str]] = {}
    for giving, taking, what in SIDES:
        of_kind = [gap for gap in gaps if gap.what == what]
        meant = {gap.given.name for gap in of_kind if gap.given is not None}
        for name in _names(recording, giving, taking):
            givers, takers = (_nodes(recording, kind, name) for kind in (giving, taking))
            label = _label(recording, what, name)
            made.rows.append(_row(what, label, givers, takers))
            if takers or name in meant:
                made.boxes[what, name] = Box(what, label)
                _connect(made, what, name, givers, takers)
            else:
                for giver in givers:
                    rest.setdefault(giver, []).append(_short(what, label))
        for gap in of_kind:
            _mark(made, recording, gap, giving)
    for node, lines in rest.items():
        made.boxes["rest", node] = Box("rest", tuple(lines))
        made.arrow(("node", node), ("rest", node))
    return made


def _idle(gap: Missing) -> bool:
    """Whether a node of the world, such as the robot, just isn't told anything: that is no mistake."""
    return gap.given is None and gap.wanted.ours


def _names(recording: Recording, *kinds: str) -> list[str]:
    ends = [end for kind in kinds for end in recording.graph.ends(kind)]
    return sorted({end.name for end in ends if not end.type.startswith(MACHINERY)})


def _nodes(recording: Recording, kind: str, name: str) -> list[str]:
    nodes = dict.fromkeys(end.node for end in recording.graph.ends(kind, name))
    return [node for node in nodes if not node.rsplit("/", 1)[1].startswith("_")]


def _connect(made: Wiring, what: str, name: str, givers: list[str], takers: list[str]) -> None:
    for given, node in [*((True, one) for one in givers), *((False, one) for one in takers)]:
        ends = ("node", node), (what, name)
        made.arrow(*(ends if given == (what == "topic") else ends[::-1]))  # requests go the other way


def _mark(made: Wiring, recording: Recording, gap: Missing, giving: str) -> None:
    """Make the arrow red that shows a gap: at the end that gets nothing, if it gets nothing of anybody."""
    number = made.reasons.index(gap.reason) + 1
    box, wanted = (gap.what, gap.wanted.name), ("node", gap.wanted.node)
    if gap.given is not None and gap.given.name != gap.wanted.name:  # names that are nearly equal
        ends = (gap.what, gap.given.name), box
        made.arrow(*(ends if gap.what == "topic" else ends[::-1]), number)
    givers = recording.graph.ends(giving, gap.wanted.name)
    others = [end for end in givers if end != gap.given]
    one_of_many = gap.given is not None and gap.given in givers and others
    ends = (("node", gap.given.node), box) if one_of_many else (box, wanted)
    made.arrow(*(ends if gap.what == "topic" else ends[::-1]), number)


def _label(recording: Recording, what: str, name: str) -> tuple[str, ...]:
    """A name, and how much goes on there."""
    if what == "service":
        return name, _count(len(recording.calls_of(name)), "service", "call")
    if what == "action":
        return name, _count(len(recording.goals_of(name)), "action", "goal")
    moments = stamps(recording.messages(name))
    hertz = rate(moments)
    if hertz:
        return name, f"{hertz:.3g} Hz"
    return name, f"{len(moments)} message{'s' * (len(moments) != 1)}"


def _count(number: int, what: str, noun: str) -> str:
    return f"{what}, {number} {noun}{'s' * (number != 1)}"


def _short(what: str, label: tuple[str, ...]) -> str:
    name, much = label
    return f"{name}  {much if what == 'topic' else what}"


def _row(what: str, label: tuple[str, ...], givers: list[str], takers: list[str]) -> str:
    name, much = label
    ends = [", ".join(nodes) or "nobody" for nodes in (givers, takers)]
    ends = ends if what == "topic" else ends[::-1]
    kind = f"{what} " if what == "topic" else ""
    return f"{kind}{name} ({much}): {ends[0]} -> {ends[1]}"


def columns(made: Wiring) -> Iterator[tuple[Key, Box]]:
    """All boxes, those without any arrow last."""
    joined = {key for pair in made.arrows for key in pair}
    yield from sorted(made.boxes.items(), key=lambda item: item[0] not in joined)
