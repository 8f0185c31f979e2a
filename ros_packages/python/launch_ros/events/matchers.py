"""Matchers for nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def matches_node_name(node_name: str) -> Callable[[Any], bool]:
    """A matcher that returns True for node actions with this full name; its first slash may be left out."""
    name = node_name if node_name.startswith("/") else f"/{node_name}"
    return lambda action: action.node_name == name
