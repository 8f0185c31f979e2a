"""The `ros2` commands, in a terminal and as `%ros2` in a notebook, with official options and output.

Each verb is a function of a system and options. A system is what the commands inspect and use: nodes in other
processes, a running player, or a recording.
"""

from __future__ import annotations

import builtins
from types import SimpleNamespace
from typing import Any


def register_magic() -> None:
    """Register %ros2 if this is a notebook. The commands are imported when it is used."""
    shell = getattr(builtins, "get_ipython", lambda: None)()
    if shell is not None:
        _ros2._ipython_magic_no_var_expand = True  # type: ignore[attr-defined]  # braces are YAML's, not Python's
        shell.register_magic_function(_ros2, magic_kind="line", magic_name="ros2")
        shell.Completer.custom_matchers.append(_complete)


def _ros2(line: str) -> None:
    """ros2 commands on the running player or the last run: %ros2 topic list"""
    from sim.ros2.notebook import ros2

    ros2(line)


def _complete(context: Any) -> dict[str, Any]:
    """The completions of the last word of a line with %ros2, for IPython when Tab is pressed."""
    line = context.text_until_cursor.lstrip()
    if not line.startswith("%ros2 "):
        return {"completions": []}
    from sim.ros2.notebook import completions

    found = completions(line.removeprefix("%ros2").lstrip())
    words = [SimpleNamespace(text=word, type="ros2") for word in found]
    return {"completions": words, "suppress": True, "matched_fragment": line.split(" ")[-1]}


# As IPython.core.completer.context_matcher does.
_complete.matcher_api_version = 2  # type: ignore[attr-defined]
_complete.matcher_priority = 100  # type: ignore[attr-defined]
_complete.matcher_identifier = "ros2"  # type: ignore[attr-defined]
