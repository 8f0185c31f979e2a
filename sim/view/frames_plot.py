"""`plot_frames`: the TF tree of a run, with the publisher of each transform."""

from __future__ import annotations

from typing import NamedTuple

from sim.evidence import Recording, rate
from sim.view.graph_diagram import GraphBox, GraphDiagram, Key
from sim.view.graph_plot import GraphPlot, draw_diagram

MOVING, STATIC = "/tf", "/tf_static"


class PublishedTransform(NamedTuple):
    """The transforms from a parent to a child frame by one node, static or with stamps."""

    parent: str
    child: str
    sender: str
    static: bool
    stamps: list[float]  # s

    @property
    def source(self) -> str:
        """The rate and the publisher."""
        hertz = rate(self.stamps)
        often = "static" if self.static else f"{hertz:.3g} Hz" if hertz else "once"
        return f"{often}, {self.sender}"


def plot_frames(recording: Recording) -> GraphPlot:
    """Draw the tree of frames that a run's nodes published on /tf and /tf_static, from parent to child.

    Each box has the frame, the rate of its transform and the publishing node. Errors are listed in red below:
    a frame with two parents, or unconnected trees.

    The `description` of the returned plot has the same as text.
    """
    transforms = _published_transforms(recording)
    diagram = GraphDiagram(rows=[f"{one.child} in {one.parent}: {one.source}" for one in transforms])
    parents: dict[str, list[str]] = {}
    for one in transforms:
        parents.setdefault(one.child, []).append(one.parent)
    for frame in dict.fromkeys(name for one in transforms for name in (one.parent, one.child)):
        sources = [one.source for one in transforms if one.child == frame]
        from_course = all(_from_course(recording, transforms, frame))
        diagram.boxes[_key(frame)] = GraphBox("node", (frame, *sources), from_course)
    for child, several in parents.items():
        if len(set(several)) > 1:
            diagram.reasons.append(
                f"{child} has two parents, {' and '.join(dict.fromkeys(several))}: that is not a tree."
            )
        for parent in several:
            gap = len(diagram.reasons) if len(set(several)) > 1 else 0
            diagram.add_arrow(_key(parent), _key(child), gap)
    roots = [frame for frame in dict.fromkeys(one.parent for one in transforms) if frame not in parents]
    if len(roots) > 1:
        names = " and ".join(roots)
        diagram.reasons.append(f"There are {len(roots)} trees, and no path connects {names}.")
    if not transforms:
        diagram.rows.append("No node published a frame.")
        diagram.boxes[_key("")] = GraphBox("rest", ("no frames",))
    return draw_diagram(diagram, recording.failure)


def _key(frame: str) -> Key:
    return "frame", frame


def _from_course(recording: Recording, transforms: list[PublishedTransform], frame: str) -> list[bool]:
    return [recording.is_course_node(one.sender) for one in transforms if one.child == frame]


def _published_transforms(recording: Recording) -> list[PublishedTransform]:
    """One row per pair of frames and node, in the order of the first transform."""
    found: dict[tuple[str, str, str], PublishedTransform] = {}
    for topic in (STATIC, MOVING):
        for received in recording.messages(topic):
            for one in received.message.transforms:
                parent, child = one.header.frame_id, one.child_frame_id
                new = PublishedTransform(parent, child, received.sender, topic == STATIC, [])
                found.setdefault((parent, child, received.sender), new).stamps.append(received.stamp)
    return list(found.values())
