"""The tree of frames of a run: which frame lies in which, and who says so."""

from __future__ import annotations

from typing import NamedTuple

from sim.evidence import Recording, rate
from sim.view.graph import GraphPlot, drawn
from sim.view.wiring import Box, Key, Wiring

MOVING, STATIC = "/tf", "/tf_static"


class Told(NamedTuple):
    """What was said of one frame: its parent, by whom, and when; static where it holds for all times."""

    parent: str
    child: str
    sender: str
    static: bool
    stamps: list[float]  # s

    @property
    def how(self) -> str:
        """How often it is said, and by whom."""
        hertz = rate(self.stamps)
        often = "static" if self.static else f"{hertz:.3g} Hz" if hertz else "once"
        return f"{often}, {self.sender}"


def plot_frames(recording: Recording) -> GraphPlot:
    """Draw the tree of frames that a run's nodes told on /tf and /tf_static, from parent to child.

    In each box: the frame, how often its place is told, and by which node. What is no tree is told in red
    below: a frame with two parents, or frames between which no way leads.

    The `words` of what this returns say the same.
    """
    told = _told(recording)
    shown = Wiring(rows=[f"{one.child} in {one.parent}: {one.how}" for one in told])
    parents: dict[str, list[str]] = {}
    for one in told:
        parents.setdefault(one.child, []).append(one.parent)
    for frame in dict.fromkeys(name for one in told for name in (one.parent, one.child)):
        how = [one.how for one in told if one.child == frame]
        shown.boxes[_key(frame)] = Box("node", (frame, *how), all(_ours(recording, told, frame)))
    for child, several in parents.items():
        if len(set(several)) > 1:
            shown.reasons.append(
                f"{child} has two parents, {' and '.join(dict.fromkeys(several))}: that is no tree."
            )
        for parent in several:
            shown.arrow(_key(parent), _key(child), len(shown.reasons) if len(set(several)) > 1 else 0)
    roots = [frame for frame in dict.fromkeys(one.parent for one in told) if frame not in parents]
    if len(roots) > 1:
        shown.reasons.append(f"There are {len(roots)} trees, and no way leads between {' and '.join(roots)}.")
    if not told:
        shown.rows.append("No node told of a frame.")
        shown.boxes[_key("")] = Box("rest", ("no frames",))
    return drawn(shown)


def _key(frame: str) -> Key:
    return "frame", frame


def _ours(recording: Recording, told: list[Told], frame: str) -> list[bool]:
    return [recording.is_course_node(one.sender) for one in told if one.child == frame]


def _told(recording: Recording) -> list[Told]:
    """What was said, each pair of frames by each node once, in the order in which it was first said."""
    found: dict[tuple[str, str, str], Told] = {}
    for topic in (STATIC, MOVING):
        for heard in recording.messages(topic):
            for one in heard.message.transforms:
                parent, child = one.header.frame_id, one.child_frame_id
                new = Told(parent, child, heard.sender, topic == STATIC, [])
                found.setdefault((parent, child, heard.sender), new).stamps.append(heard.stamp)
    return list(found.values())
