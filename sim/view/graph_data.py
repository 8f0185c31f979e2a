"""A graph as plain data for the pages that draw it; `checkGraph` in web/checks.js parses it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sim.evidence import Recording
from sim.view.graph_diagram import graph_diagram
from sim.view.graph_layout import lay_out

PIXELS = 108  # per inch, so that letters are 12 pixels high
MAX_WIDTH = 5.0  # inches: a panel beside a notebook is narrow
MARGIN = 8  # pixels
CHARACTERS = 20_000  # of the description


def graph_data(
    recording: Recording, *, counted: bool = True, max_width: float = MAX_WIDTH
) -> dict[str, Any] | None:
    """The layout of a graph in pixels, ready for JSON; None if there is no node.

    counted: as in `graph_diagram`. If False, the page itself writes rates into the boxes of topics.
    max_width: inches; a graph that would be wider is drawn from top to bottom.
    """
    diagram = graph_diagram(recording, counted=counted)
    if not diagram.boxes:
        return None
    layout = lay_out(diagram, max_width)
    return {
        "width": round(layout.width * PIXELS) + 2 * MARGIN,
        "height": round(layout.height * PIXELS) + 2 * MARGIN,
        "boxes": [
            {
                "kind": "course" if box.from_course else box.kind,
                "lines": list(box.lines),
                "name": key[1],
                "place": _pixels([center[0] - size[0] / 2, center[1] - size[1] / 2]) + _sizes(size),
            }
            for key, (box, center, size) in zip(diagram.boxes, layout.boxes, strict=True)
        ],
        "arrows": [
            {
                "gap": arrow.gap,
                "rest": arrow.end[0] == "rest",
                "points": _pixels(value for point in points for value in point),
                "middle": _pixels(middle),
            }
            for arrow, points, middle in layout.arrows
        ],
        "reasons": diagram.reasons,
        "more": diagram.omitted,
        "words": diagram.text[:CHARACTERS],
    }


def _pixels(values: Iterable[float]) -> list[int]:
    return [round(value * PIXELS) + MARGIN for value in values]


def _sizes(values: Iterable[float]) -> list[int]:
    return [round(value * PIXELS) for value in values]
