"""Where the boxes of a picture lie: in a row of layers, with few crossings, by grandalf."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from typing import NamedTuple, TypeVar

from grandalf.graphs import Edge, Graph, Vertex
from grandalf.layouts import SugiyamaLayout

K = TypeVar("K", bound=Hashable)
Point = tuple[float, float]
BETWEEN_LAYERS, BETWEEN_BOXES = 0.38, 0.16  # inches


class Layout(NamedTuple):
    """Centres of boxes and the ways of arrows, in inches: along the row of layers, and across it."""

    centres: dict
    ways: dict  # (begin, end) to points, the two boxes' centres included
    along: float
    across: float


class _Vertex(Vertex):
    """Has a place of its own in grandalf's sets: by default that is its address, which changes each time."""

    def __init__(self, key: Hashable, number: int) -> None:
        super().__init__(key)
        self._number = number

    def __hash__(self) -> int:
        return self._number


class _Edge(Edge):
    """The same for an edge."""

    def __init__(self, begin: Vertex, end: Vertex, number: int) -> None:
        super().__init__(begin, end)
        self._number, self.view = number, _Way()

    def __hash__(self) -> int:
        return self._number


class _View:
    """What grandalf asks of a vertex; its layers lie one below another."""

    def __init__(self, along: float, across: float) -> None:
        self.w, self.h, self.xy = across, along, (0.0, 0.0)


class _Way:
    def __init__(self) -> None:
        self.points: list[Point] = []

    def setpath(self, points: list[Point]) -> None:
        """As grandalf calls it."""
        self.points = list(points)


def layered(sizes: Mapping[K, Point], arrows: Iterable[tuple[K, K]]) -> Layout:
    """Lay out boxes of these sizes, (along, across) in inches; separate parts lie side by side."""
    vertices = {key: _Vertex(key, number) for number, key in enumerate(sizes)}
    for key, vertex in vertices.items():
        vertex.view = _View(*sizes[key])
    edges = [_Edge(vertices[begin], vertices[end], number) for number, (begin, end) in enumerate(arrows)]
    centres: dict[K, Point] = {}
    ways: dict[tuple[K, K], list[Point]] = {}
    along = across = 0.0
    parts = Graph(list(vertices.values()), edges).C
    for part in sorted(parts, key=lambda part: (-len(part.sV), str(next(iter(part.sV)).data))):
        _lay_out(part)
        boxes = [vertex.view for vertex in part.sV]
        bends = [point[0] for edge in part.sE for point in edge.view.points]
        left = min(view.xy[1] - view.h / 2 for view in boxes)
        top = min([*(view.xy[0] - view.w / 2 for view in boxes), *bends])

        def place(point: Point, left: float = left, top: float = top - across) -> Point:
            return point[1] - left, point[0] - top

        for vertex in part.sV:
            centres[vertex.data] = place(vertex.view.xy)
        for edge in part.sE:
            ends = edge.v[0], edge.v[1]
            points = edge.view.points or [end.view.xy for end in ends]
            ways[ends[0].data, ends[1].data] = [place(point) for point in points]
        along = max(along, max(view.xy[1] + view.h / 2 for view in boxes) - left)
        across += max([*(view.xy[0] + view.w / 2 for view in boxes), *bends]) - top + BETWEEN_BOXES
    return Layout(centres, ways, along, across)


def _lay_out(part: Graph) -> None:
    layout = SugiyamaLayout(part)
    layout.yspace, layout.xspace = BETWEEN_LAYERS, BETWEEN_BOXES
    layout.dw = layout.dh = 0.1  # size of the points at which an arrow passes a layer
    layout.init_all()
    layout.draw(4)
