"""The configuration of JupyterLab for students, started by `make lab`."""
import os
import sys
from pathlib import Path

from grader.course_files import work_folder

c = get_config()  # noqa: F821  (Jupyter provides it)

HERE = Path(__file__).parent
COURSE = HERE.parent
for sentence in work_folder.update_work_folder(COURSE):
    print(sentence)
c.ServerApp.root_dir = str(work_folder.find_work_folder(COURSE))
c.LabApp.default_url = "/lab"  # where the course's extension opens the start page
# In a container root is the default user; elsewhere Jupyter is not started as root by accident.
c.ServerApp.allow_root = os.geteuid() == 0
# Students don't need nbgrader's extensions: its panels are hidden in labconfig/page_config.json, and the
# course has its own Validate button, which shows points and doesn't block the server.
# Notebook 7 has neither the robot panel nor Validate: its addresses lead to JupyterLab.
sys.path.append(str(HERE))  # the folder of lab_addresses and start_page
c.ServerApp.jpserver_extensions = {
    "notebook": False,
    "lab_addresses": True,
    "start_page": True,
    "nbgrader.server_extensions.validate_assignment": False,
    "nbgrader.server_extensions.formgrader": False,
    "nbgrader.server_extensions.assignment_list": False,
    "nbgrader.server_extensions.course_list": False,
}
# The course's extension (robot panel, Validate, ...) is written by hand and needs no build.
c.LabApp.extra_labextensions_path = [str(HERE / "labextensions")]
# A closed notebook keeps its kernel, 150 to 220 MB, for half an hour after the last activity. What runs is
# activity, and so are the frames of a robot that plays.
c.MappingKernelManager.cull_idle_timeout = 30 * 60
c.MappingKernelManager.cull_interval = 60
# The course has no language server, and each start of JupyterLab would run npm to look for some.
c.LanguageServerManager.autodetect = False
# Terminals find colcon and ros2 in PATH, like cells. Jupyter may start a login shell by default, which would
# reset PATH; and the scripts that colcon writes are for bash.
c.ServerApp.terminado_settings = {"shell_command": ["bash", "--rcfile", str(HERE / "terminal.bashrc")]}
os.environ["ROS2_COURSE"] = str(COURSE)
os.environ["PATH"] = os.pathsep.join([os.path.join(sys.prefix, "bin"), os.environ.get("PATH", os.defpath)])
os.environ["PYTHONSTARTUP"] = str(HERE / "kernel_start.py")  # executed by kernels, too
