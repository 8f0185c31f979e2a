"""Says what to do where colcon is not installed, which builds packages."""

import re
import shutil

SENTENCE = (
    "colcon, which builds packages, is not installed here: run `pip install 'ros2-notebook-course[lab]'` in "
    "a terminal and restart the kernel. Without it, cells that use a built package end with an error."
)
_COMMAND = re.compile(r"\bcolcon (build|test)\b")


def missing_colcon(cell: str) -> str:
    """The sentence if a cell starts colcon, in `!`, %%bash or the like, and there is none; "" otherwise."""
    commands = cell if cell.startswith("%%") else "\n".join(re.findall(r"^\s*!.*", cell, re.M))
    return SENTENCE if _COMMAND.search(commands) and shutil.which("colcon") is None else ""
