"""The folders from which the course's code is imported.

They may belong to two copies of the course: Python takes `sim` and `grader` from the working folder, and what
is in ros_packages/python from the copy that .venv was made for.
"""

import importlib.util
from pathlib import Path

COURSE = Path(__file__).parents[1]
_installed = importlib.util.find_spec("launch_process_starters")  # None where only `sim` is used
_found = _installed and _installed.origin
ROS_PACKAGES = Path(_found).parents[1] if _found else COURSE / "ros_packages"
FILES = ROS_PACKAGES.parent
"""The folder of lessons, exercises, LICENSE and so on: in a clone the course, of a wheel ros2_course/."""
