"""The JavaScript of the pages, concatenated from files in web/ without a build tool."""

from __future__ import annotations

import base64
import json
import zlib
from importlib.resources import files

_WEB = files("sim.view") / "web"
_BASE = ("checks.js", "elements.js", "theme.js")
_WORLD = ("drawing.js", "camera.js", "legend.js", "layers.js", "layer_paint.js", "world_canvas.js")
_PICTURE = (*_BASE, *_WORLD, "graph.js", "topic.js")
_FILES = {
    "live.js": _PICTURE,
    "replay.js": (*_PICTURE, "cursor.js", "packed.js", "replay_run.js"),
    "plots.js": (*_BASE, "cursor.js", "packed.js"),
    "prediction.js": ("elements.js",),
    "order_game.js": ("elements.js",),
}
_SHEETS = {"prediction.js": "prediction.css", "order_game.js": "order_game.css"}


def script(part: str) -> str:
    """One file of web/, preceded by those that it uses and the style sheet as the constant `STYLE`."""
    names = (_SHEETS.get(part, "view.css"), *_FILES[part], part)
    style, *texts = (_WEB.joinpath(name).read_text(encoding="utf-8") for name in names)
    return "\n".join([f"const STYLE = {json.dumps(style)};", *texts])


def packed(source: str) -> str:
    """A script that unpacks and runs `source` in a scope of its own; it has half the size, or less."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    whole = f'(() => {{\n"use strict";\n{source}\n}})();'
    data = base64.b64encode(deflate.compress(whole.encode()) + deflate.flush()).decode()
    return _UNPACK.replace("DATA", data)


_UNPACK = """(async () => {
const bytes = Uint8Array.from(atob("DATA"), (character) => character.charCodeAt(0));
const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
const script = document.createElement("script");
script.textContent = await new Response(stream).text();
document.head.append(script);
script.remove();
})();"""
