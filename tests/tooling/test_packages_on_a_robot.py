"""The package of lesson 11 as its cells write it; built and launched in a terminal beside `python -m sim`."""

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tests.sim.standalone.programs import environment, robot

LESSON = Path(__file__).parents[2] / "course" / "11_packages"
PACKAGE = "%%writefile ws/src/my_robot/"
LAUNCH = f"ros2 launch my_robot one.launch.yaml gap:=1.0 sigterm_timeout:={PATIENCE}"
IN_A_TERMINAL = f"source ws/install/setup.bash && exec {LAUNCH}"


def magics(notebook):
    """The first line of each cell of lesson 11, and the rest of it."""
    cells = json.loads((LESSON / notebook).read_text("utf-8"))["cells"]
    return ["".join(cell["source"]).partition("\n")[::2] for cell in cells]


def write_workspace(folder):
    """Write what the cells of the second notebook write of my_robot."""
    shutil.copytree(LESSON / "finished", folder / "finished", dirs_exist_ok=True)
    for first, text in magics("launching.ipynb"):
        if first == "%%bash":
            subprocess.run(["bash", "-ec", text], cwd=folder, env=terminal(), check=True)
        elif first.startswith(PACKAGE):
            (folder / first.split()[1]).write_text(text)


def terminal(**more):
    """The environment of JupyterLab's terminal."""
    words = environment(**more)
    words.pop("PYTHONPATH")
    return words | {"PATH": f"{sys.prefix}/bin:{words['PATH']}"}


def test_the_second_notebook_begins_with_the_files_that_the_first_one_writes():
    written: dict[str, str] = {}
    for first, text in magics("lesson.ipynb"):
        if PACKAGE in first.replace(" -a ", " "):
            name, before = first.rpartition("/")[2], "" if " -a " not in first else written["stopper.py"]
            written[name] = f"{before}{text}\n"
    finished = {path.name: path.read_text("utf-8") for path in (LESSON / "finished").iterdir()}
    assert {name: text.rstrip() for name, text in written.items()} == {
        name: text.rstrip() for name, text in finished.items()
    }


@pytest.mark.soak  # it builds a package, and launches it in real time
def test_the_package_of_lesson_11_drives_a_robot_until_ctrl_c(tmp_path):
    write_workspace(tmp_path)
    build = ["colcon", "build", "--packages-select", "my_robot"]
    subprocess.run(build, cwd=tmp_path / "ws", env=terminal(), check=True)
    with robot("--world", "yard", "--headless") as yard:
        domain = {"ROS_DOMAIN_ID": str(yard.domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        launched = subprocess.Popen(
            ["bash", "-c", IN_A_TERMINAL],
            cwd=tmp_path, env=terminal(**domain), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        try:
            yard.receive_until(lambda received: received["v"] > 0.25)
        finally:
            launched.send_signal(signal.SIGINT)
            said = launched.communicate(timeout=PATIENCE)[0]
        yard.receive_until(lambda received: received["v"] == 0.0)
    assert "I stop 1.0 m before a wall" in said
    assert "process has finished cleanly" in said
    assert launched.returncode == 0, said
