"""The pages' JavaScript, put together from files in web/; no tool builds it."""

from __future__ import annotations

import json
from importlib.resources import files

_WEB = files("sim.view") / "web"
_SHARED = ("checks.js", "parts.js", "theme.js", "drawing.js", "scene.js", "graph.js")
_MORE = {"live.js": ("topic.js",)}


def script(part: str) -> str:
    """One file of web/ after those that all pages share, and the style sheet of the page as `STYLE`."""
    names = ("look.css", *_SHARED, *_MORE.get(part, ()), part)
    look, *texts = (_WEB.joinpath(name).read_text(encoding="utf-8") for name in names)
    return "\n".join([f"const STYLE = {json.dumps(look)};", *texts])
