"""The words of `ros2`, as the official tools have them: in a terminal, and as `%ros2` in a notebook.

Each verb is a function of a system and its options. A system is what the words are about: nodes in other
processes, a play that is going on, or a recording.
"""

from __future__ import annotations

import builtins


def offer() -> None:
    """Let the notebook, if this is one, know %ros2. The words themselves are imported as one is said."""
    shell = getattr(builtins, "get_ipython", lambda: None)()
    if shell is not None:
        _ros2._ipython_magic_no_var_expand = True  # braces in it are YAML's, not Python's
        shell.register_magic_function(_ros2, magic_kind="line", magic_name="ros2")


def _ros2(line: str) -> None:
    """The words of ros2 about the play that is going on, or the last run: %ros2 topic list"""
    from sim.ros2.notebook import ros2

    ros2(line)
