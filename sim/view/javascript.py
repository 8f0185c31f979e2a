"""The JavaScript of the pages, concatenated from files in web/ without a build tool."""

from __future__ import annotations

import json
from importlib.resources import files

_WEB = files("sim.view") / "web"
_SHARED = ("checks.js", "elements.js", "theme.js", "drawing.js", "world_canvas.js", "graph.js")
_MORE = {"live.js": ("topic.js",)}


def script(part: str) -> str:
    """One file of web/, preceded by the shared files and the style sheet as the constant `STYLE`."""
    names = ("view.css", *_SHARED, *_MORE.get(part, ()), part)
    style, *texts = (_WEB.joinpath(name).read_text(encoding="utf-8") for name in names)
    return "\n".join([f"const STYLE = {json.dumps(style)};", *texts])
