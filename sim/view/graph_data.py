"""A graph as plain data for the pages that draw it; `checkGraph` in web/checks.js reads it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sim.evidence import Recording
from sim.view.arranged import arranged
from sim.view.wiring import wiring

PIXELS = 108  # in an inch: then letters are 12 pixels high
WIDEST = 5.0  # inches: a page beside a notebook is narrow
MARGIN = 8  # pixels
CHARACTERS = 20_000  # in words


def graph_data(recording: Recording, *, counted: bool = True) -> dict[str, Any] | None:
    """What a page draws, in pixels, ready for JSON; None where there is no node.

    counted: as of `wiring`. Without, the page itself writes rates into the boxes of topics.
    """
    shown = wiring(recording, counted=counted)
    if not shown.boxes:
        return None
    placed = arranged(shown, WIDEST)
    return {
        "width": round(placed.width * PIXELS) + 2 * MARGIN,
        "height": round(placed.height * PIXELS) + 2 * MARGIN,
        "boxes": [
            {
                "kind": "ours" if box.from_course else box.kind,
                "lines": list(box.lines),
                "name": key[1],
                "place": _pixels([centre[0] - size[0] / 2, centre[1] - size[1] / 2]) + _sizes(size),
            }
            for key, (box, centre, size) in zip(shown.boxes, placed.boxes, strict=True)
        ],
        "arrows": [
            {
                "gap": arrow.gap,
                "rest": arrow.end[0] == "rest",
                "points": _pixels(value for point in points for value in point),
                "middle": _pixels(middle),
            }
            for arrow, points, middle in placed.arrows
        ],
        "reasons": shown.reasons,
        "more": shown.left_out,
        "words": shown.text[:CHARACTERS],
    }


def _pixels(values: Iterable[float]) -> list[int]:
    return [round(value * PIXELS) + MARGIN for value in values]


def _sizes(values: Iterable[float]) -> list[int]:
    return [round(value * PIXELS) for value in values]
