"""Packs the data of replays and plots for pages; web/packed.js unpacks it."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from itertools import pairwise
from typing import Any


def deflated(data: dict[str, Any]) -> str:
    """Data as base64 of deflated JSON."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


def inflated(text: str) -> dict[str, Any]:
    """The inverse of `deflated`."""
    return dict(json.loads(zlib.decompress(base64.b64decode(text), -15)))


def differences(values: Sequence[int]) -> list[int]:
    """Whole numbers as differences, the first one from 0: they compress well."""
    return [*values[:1], *(after - now for now, after in pairwise(values))]
