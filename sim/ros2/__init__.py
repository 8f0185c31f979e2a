"""The `ros2` commands, in a terminal and as `%ros2` in a notebook, with official options and output.

Each verb is a function of a system and options. A system is what the commands inspect and use: nodes in other
processes, a running player, or a recording.
"""

from __future__ import annotations

import builtins


def register_magic() -> None:
    """Register %ros2 if this is a notebook. The commands are imported when it is used."""
    shell = getattr(builtins, "get_ipython", lambda: None)()
    if shell is not None:
        _ros2._ipython_magic_no_var_expand = True  # braces are YAML's, not Python's
        shell.register_magic_function(_ros2, magic_kind="line", magic_name="ros2")


def _ros2(line: str) -> None:
    """ros2 commands on the running player or the last run: %ros2 topic list"""
    from sim.ros2.notebook import ros2

    ros2(line)
