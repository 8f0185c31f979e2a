"""JupyterLab as `make teach` starts it: the instructor's view, with the formgrader and Create Assignment."""
import os
import sys
from pathlib import Path

c = get_config()  # noqa: F821  (Jupyter provides it)

c.ServerApp.root_dir = str(Path(__file__).parents[2])
c.LabApp.default_url = "/teach"
# In a container root is the ordinary user; elsewhere nobody starts Jupyter as root by accident.
c.ServerApp.allow_root = os.geteuid() == 0
# The two lists are for nbgrader's exchange, a folder that all students share; this course needs none.
sys.path.append(str(Path(__file__).parent))  # where formgrader_first lies
c.ServerApp.jpserver_extensions = {
    "formgrader_first": True,
    "nbgrader.server_extensions.formgrader": True,
    "nbgrader.server_extensions.validate_assignment": True,
    "nbgrader.server_extensions.assignment_list": False,
    "nbgrader.server_extensions.course_list": False,
}
