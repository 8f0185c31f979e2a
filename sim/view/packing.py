"""Packs the data of replays and plots for pages; web/packed.js unpacks it."""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any


def deflated(data: dict[str, Any]) -> str:
    """Data as base64 of deflated JSON."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


def inflated(text: str) -> dict[str, Any]:
    """The inverse of `deflated`."""
    return dict(json.loads(zlib.decompress(base64.b64decode(text), -15)))
