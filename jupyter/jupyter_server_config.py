"""JupyterLab as `make lab` starts it: the students' view of the course."""
import os
import sys
from pathlib import Path

from grader import workplace

c = get_config()  # noqa: F821  (Jupyter provides it)

HERE = Path(__file__).parent
COURSE = HERE.parent
for sentence in workplace.lay_out(COURSE):
    print(sentence)
c.ServerApp.root_dir = str(COURSE / workplace.FOLDER)
c.LabApp.default_url = "/lab/tree/course/start.ipynb"
# In a container root is the ordinary user; elsewhere nobody starts Jupyter as root by accident.
c.ServerApp.allow_root = os.geteuid() == 0
# A student needs nothing of nbgrader: its panels are hidden in labconfig/page_config.json, and the Validate
# button is ours, which shows points and lets the server go on meanwhile.
c.ServerApp.jpserver_extensions = {
    "nbgrader.server_extensions.validate_assignment": False,
    "nbgrader.server_extensions.formgrader": False,
    "nbgrader.server_extensions.assignment_list": False,
    "nbgrader.server_extensions.course_list": False,
}
# The robot beside the code, Validate and more: written by hand, and loaded from here as it is.
c.LabApp.extra_labextensions_path = [str(HERE / "labextensions")]
# A terminal knows colcon and ros2, as a cell does. A login shell, which Jupyter may start otherwise, would
# forget it; and what colcon writes is sourced by bash.
c.ServerApp.terminado_settings = {"shell_command": ["bash"]}
os.environ["PATH"] = os.pathsep.join([os.path.join(sys.prefix, "bin"), os.environ.get("PATH", os.defpath)])
os.environ["PYTHONSTARTUP"] = str(HERE / "kernel_start.py")  # kernels run it, too
