"""JupyterLab as `make lab` starts it: the students' view of the course."""
import os
from pathlib import Path

c = get_config()  # noqa: F821  (Jupyter provides it)

c.ServerApp.root_dir = str(Path(__file__).parents[1])
c.LabApp.default_url = "/lab/tree/course/00_robot/lesson.ipynb"
# In a container root is the ordinary user; elsewhere nobody starts Jupyter as root by accident.
c.ServerApp.allow_root = os.geteuid() == 0
# Of nbgrader a student needs the Validate button alone. Its panels are hidden in labconfig/page_config.json.
c.ServerApp.jpserver_extensions = {
    "nbgrader.server_extensions.validate_assignment": True,
    "nbgrader.server_extensions.formgrader": False,
    "nbgrader.server_extensions.assignment_list": False,
    "nbgrader.server_extensions.course_list": False,
}
