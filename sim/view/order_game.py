"""A node's callbacks in a notebook, with a button and a key for each: the user decides which comes next."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from typing import Any, Protocol

import anywidget
import traitlets
from IPython.display import display

from sim.evidence import Recording
from sim.view.javascript import script

HOW = "Run this cell to play."


class ScheduledNode(Protocol):
    """A node, and the picks so far; as of ByHand in sim/ros/exploring."""

    position: Any
    picks: list[int]
    threads: bool

    def pick(self, number: int) -> Any:
        """Let a call continue."""

    def undo(self) -> Any:
        """Take back the last pick."""

    def restart(self) -> Any:
        """Take back all picks."""


class OrderGame(anywidget.AnyWidget):
    """The callbacks that are due, their code, what has run, and the node's attributes.

    watch: returns a string about the run so far. The page sends {"pick": 1}, {"undo": True} or
    {"restart": True}.
    """

    _esm = script("order_game.js")
    state = traitlets.Dict().tag(sync=True)

    def __init__(self, game: ScheduledNode, watch: Callable[[Recording], str] | None = None) -> None:
        super().__init__()
        self._game, self._watch = game, watch
        self.orders = 0  # that were played to the end
        self._update()
        self.on_msg(self._on_message)

    def show(self) -> None:
        """Display it in the output of the running cell; pages without a kernel show how it begins."""
        bundle: Any = self._repr_mimebundle_()
        data = bundle[0] if isinstance(bundle, tuple) else bundle
        display({**data, "text/html": self._page(), "text/plain": repr(self)}, raw=True)

    def __repr__(self) -> str:
        return f"OrderGame({self.state['text']})"

    def _on_message(self, _: Any, content: Any, __: Any) -> None:
        """Do what the page sends, if it is possible now."""
        command = content if isinstance(content, dict) else {}
        if command.get("pick") in self._game.position.choices:
            self._game.pick(command["pick"])
            self.orders += self._game.position.holds is not None
        elif command.get("undo") is True:
            self._game.undo()
        elif command.get("restart") is True:
            self._game.restart()
        self._update()

    def _update(self) -> None:
        position = self._game.position
        calls = zip(position.calls, position.lines, strict=True)
        watched = self._watch(position.recording) if self._watch else ""
        self.state = {
            "threads": self._game.threads,
            "calls": [
                {"name": _title(call), "state": call.state, "line": call.line, "lines": lines}
                for call, lines in calls
            ],
            "choices": position.choices,
            "done": position.done,
            "values": position.values,
            "watched": watched,
            "holds": position.holds,
            "text": position.text,
            "orders": self.orders,
        }

    def _page(self) -> str:
        """The callbacks and their code, for pages without a kernel."""
        parts = [f"<p><i>{HOW}</i></p>"]
        for number, call in enumerate(self.state["calls"], 1):
            code = "\n".join(text for _, text in call["lines"])
            parts.append(f"<p><b>{number}</b> {escape(call['name'])}</p><pre>{escape(code)}</pre>")
        return f'<div class="ros2-order-game">{"".join(parts)}</div>'


def _title(call: Any) -> str:
    """The call with what it is given, if that is short."""
    given = ", ".join(map(repr, call.arguments))
    return f"{call.name}({given if len(given) <= 20 else '…'})"
