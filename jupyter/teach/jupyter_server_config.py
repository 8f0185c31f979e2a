"""The configuration of JupyterLab for instructors (`make teach`), with formgrader and Create Assignment."""
import os
import sys
from pathlib import Path

c = get_config()  # noqa: F821  (Jupyter provides it)

c.ServerApp.root_dir = str(Path(__file__).parents[2])
c.LabApp.default_url = "/teach"
# In a container root is the default user; elsewhere Jupyter is not started as root by accident.
c.ServerApp.allow_root = os.geteuid() == 0
# The two lists are for nbgrader's exchange, a folder shared by all students, which this course doesn't need.
sys.path.append(str(Path(__file__).parent))  # the folder of formgrader_first
c.ServerApp.jpserver_extensions = {
    "formgrader_first": True,
    "nbgrader.server_extensions.formgrader": True,
    "nbgrader.server_extensions.validate_assignment": True,
    "nbgrader.server_extensions.assignment_list": False,
    "nbgrader.server_extensions.course_list": False,
}
