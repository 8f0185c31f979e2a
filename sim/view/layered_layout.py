"""Layered graph layout with few crossings (Sugiyama), by grandalf."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from typing import Any, NamedTuple, TypeVar

from grandalf.graphs import Edge, Graph, Vertex
from grandalf.layouts import SugiyamaLayout

K = TypeVar("K", bound=Hashable)
Point = tuple[float, float]
BETWEEN_LAYERS, BETWEEN_BOXES = 0.38, 0.16  # inches


class LayeredLayout(NamedTuple):
    """Centers of boxes and paths of arrows, in inches: along the sequence of layers, and across it."""

    centers: dict[Any, Point]
    paths: dict[tuple[Any, Any], list[Point]]  # (begin, end) to points, including the two boxes' centers
    along: float
    across: float


class _Vertex(Vertex):  # type: ignore[misc]  # grandalf has no types
    """A vertex with a deterministic hash; the default one is its address, which differs between runs."""

    def __init__(self, key: Hashable, number: int) -> None:
        super().__init__(key)
        self._number = number

    def __hash__(self) -> int:
        return self._number


class _Edge(Edge):  # type: ignore[misc]
    """An edge with a deterministic hash."""

    def __init__(self, begin: Vertex, end: Vertex, number: int) -> None:
        super().__init__(begin, end)
        self._number, self.view = number, _Path()

    def __hash__(self) -> int:
        return self._number


class _View:
    """The size and position of a vertex as grandalf expects it; its layers are below one another."""

    def __init__(self, along: float, across: float) -> None:
        self.w, self.h, self.xy = across, along, (0.0, 0.0)


class _Path:
    def __init__(self) -> None:
        self.points: list[Point] = []

    def setpath(self, points: list[Point]) -> None:
        """Called by grandalf."""
        self.points = list(points)


def layered_layout(sizes: Mapping[K, Point], arrows: Iterable[tuple[K, K]]) -> LayeredLayout:
    """Lay out boxes of these sizes, (along, across) in inches; unconnected parts are side by side."""
    vertices = {key: _Vertex(key, number) for number, key in enumerate(sizes)}
    for key, vertex in vertices.items():
        vertex.view = _View(*sizes[key])
    edges = [_Edge(vertices[begin], vertices[end], number) for number, (begin, end) in enumerate(arrows)]
    centers: dict[K, Point] = {}
    paths: dict[tuple[K, K], list[Point]] = {}
    along = across = 0.0
    parts = Graph(list(vertices.values()), edges).C
    for part in sorted(parts, key=lambda part: (-len(part.sV), str(next(iter(part.sV)).data))):
        _lay_out(part)
        boxes = [vertex.view for vertex in part.sV]
        bends = [point[0] for edge in part.sE for point in edge.view.points]
        left = min(view.xy[1] - view.h / 2 for view in boxes)
        top = min([*(view.xy[0] - view.w / 2 for view in boxes), *bends])

        def position(point: Point, left: float = left, top: float = top - across) -> Point:
            return point[1] - left, point[0] - top

        for vertex in part.sV:
            centers[vertex.data] = position(vertex.view.xy)
        for edge in part.sE:
            ends = edge.v[0], edge.v[1]
            points = edge.view.points or [end.view.xy for end in ends]
            paths[ends[0].data, ends[1].data] = [position(point) for point in points]
        along = max(along, max(view.xy[1] + view.h / 2 for view in boxes) - left)
        across += max([*(view.xy[0] + view.w / 2 for view in boxes), *bends]) - top + BETWEEN_BOXES
    return LayeredLayout(centers, paths, along, across)


def _lay_out(part: Graph) -> None:
    layout = SugiyamaLayout(part)
    layout.yspace, layout.xspace = BETWEEN_LAYERS, BETWEEN_BOXES
    layout.dw = layout.dh = 0.1  # size of the points at which an arrow crosses a layer
    layout.init_all()
    layout.draw(4)
