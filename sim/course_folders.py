"""The folders from which the course's code is imported.

They may belong to two copies of the course: Python takes `sim` and `grader` from the working folder, and what
is in ros_packages/python from the copy that .venv was made for.
"""

import importlib.util
from pathlib import Path

COURSE = Path(__file__).parents[1]
_installed = importlib.util.find_spec("launch_process_starters")  # None where only `sim` is used
ROS_PACKAGES = Path(_installed.origin).parents[1] if _installed else COURSE / "ros_packages"
