"""The package that grows in lessons 5 and 9: its listings, and its programs beside `python -m sim`."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tests.sim.standalone.programs import environment, robot

ROOT = Path(__file__).parents[2]
PROGRAMS = {"05_sensing/guarding": "guard", "09_frames/lesson": "mount"}
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)


def blocks(lesson, language):
    """The blocks of a language in the lesson's section on the package; "" for a terminal's."""
    cells = json.loads((ROOT / "course" / f"{lesson}.ipynb").read_text("utf-8"))["cells"]
    [text] = ["".join(cell["source"]) for cell in cells if cell["id"] == "own-package"]
    return [block for kind, block in BLOCK.findall(text) if kind == language]


@pytest.mark.parametrize("lesson", PROGRAMS)
def test_a_listing_is_a_whole_program(lesson):
    compile(blocks(lesson, "python")[0], lesson, "exec")
    assert "def main(args=None):" in blocks(lesson, "python")[0]


def terminal(**more):
    """The environment of JupyterLab's terminal."""
    words = environment(**more)
    words.pop("PYTHONPATH")
    return words | {"PATH": f"{sys.prefix}/bin:{words['PATH']}"}


def write_package(folder):
    """Write the package as the lessons do, with their line of setup.py, and build it."""
    commands = blocks("05_sensing/guarding", "")[0]
    subprocess.run(["bash", "-ec", commands], cwd=folder, env=terminal(), check=True)
    package = folder / "my_ws/src/my_nodes"
    for lesson, program in PROGRAMS.items():
        (package / "my_nodes" / f"{program}.py").write_text(blocks(lesson, "python")[0])
    setup = package / "setup.py"
    old = "'guard = my_nodes.guard:main'"
    assert old in setup.read_text()
    setup.write_text(setup.read_text().replace(old, f"{old},\n'mount = my_nodes.mount:main'"))
    subprocess.run(["colcon", "build"], cwd=folder / "my_ws", env=terminal(), check=True)


@pytest.mark.soak  # it builds a package, and runs its programs in real time
def test_the_programs_of_the_lessons_run_beside_a_robot(tmp_path):
    write_package(tmp_path)
    with robot("--world", "room", "--headless") as room:
        domain = {"ROS_DOMAIN_ID": str(room.domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        source = "cd my_ws && source install/setup.bash && exec"
        through = blocks("05_sensing/guarding", "")[2].strip()
        started = [
            subprocess.Popen(
                ["bash", "-c", f"{source} {command}"], cwd=tmp_path, env=terminal(**domain), process_group=0
            )
            for command in ("ros2 run my_nodes guard", "ros2 run my_nodes mount", through)
        ]
        try:
            for question, answer in (
                ("ros2 topic echo --once /cmd_vel", "linear"),
                ("timeout 60 ros2 topic echo /tf_static | grep -m1 'child_frame_id: camera'", "camera"),
            ):
                found = subprocess.run(
                    ["bash", "-c", question], env=terminal(**domain), capture_output=True, text=True,
                    timeout=PATIENCE, check=True,
                )  # fmt: skip
                assert answer in found.stdout
        finally:
            for process in started:
                os.killpg(process.pid, signal.SIGINT)  # as Ctrl-C does: to `ros2 run` and to its program
            for process in started:
                process.wait(PATIENCE)
