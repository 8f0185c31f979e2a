"""In a real kernel, without a page: what it knows by itself."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from jupyter_client.manager import start_new_kernel

from tests.patience import PATIENCE

ROOT = Path(__file__).parents[3]

ROBOT = "class Robot(Node):\n    def __init__(self):\n        super().__init__('robot')\n"
NOT_RUN = (
    "NameError: A cell above defines `Robot`, and it has not run: "
    "choose Run > Run All Above Selected Cell, then run this cell again."
)
SETUP = "from rclpy.node import Node\nfrom sim import play, run"


class Kernel:
    """A kernel with the notebook's file beside it, as `make lab` starts one."""

    def __init__(self, notebook) -> None:
        start = {"PYTHONSTARTUP": str(ROOT / "jupyter/kernel_start.py"), "JPY_SESSION_NAME": str(notebook)}
        self.manager, self.client = start_new_kernel(
            startup_timeout=PATIENCE, kernel_name="python3", env={**os.environ, **start}
        )

    def run(self, code: str, cell: str) -> str:
        """Run a cell; what it says."""
        session, content = self.client.session, {"code": code, "silent": False, "store_history": True}
        message = session.msg("execute_request", content, metadata={"cellId": cell})
        self.client.shell_channel.send(message)
        said = []
        while True:
            came = self.client.get_iopub_msg(timeout=PATIENCE)
            if came["parent_header"].get("msg_id") != message["header"]["msg_id"]:
                continue
            content = came["content"]
            if came["msg_type"] == "status" and content["execution_state"] == "idle":
                return "\n".join(said)
            said += [*content.get("traceback", []), content.get("data", {}).get("text/plain", "")]


@pytest.fixture
def kernel(tmp_path):
    code = {"setup": SETUP, "answer": ROBOT, "use": "run(Robot, seconds=1).ended.reason"}
    cells = [{"id": name, "cell_type": "code", "source": [text]} for name, text in code.items()]
    path = tmp_path / "robot.ipynb"
    path.write_text(json.dumps({"cells": cells}))
    kernel = Kernel(path)
    yield kernel
    kernel.client.stop_channels()
    kernel.manager.shutdown_kernel(now=True)


def test_a_name_from_a_cell_above_is_explained_before_anything_is_imported(kernel):
    assert kernel.run("Robot", "use").strip() == NOT_RUN
    assert "name 'nowhere' is not defined" in kernel.run("nowhere", "use")


def test_an_import_of_what_is_not_here_is_explained_before_anything_is_imported(kernel):
    lines = kernel.run("import cv_bridge", "use").strip().splitlines()
    assert lines[-1].startswith(
        "`cv_bridge` (converts between ROS images and OpenCV's arrays) is a ROS package that the course does "
        "not include. np.frombuffer("
    )
    assert kernel.run("import rospy", "use").strip().splitlines()[-1] == (
        "`rospy` is a package of ROS 1. ROS 2 has rclpy."
    )
    *_, error, hint = kernel.run("import zzz", "use").strip().splitlines()
    assert error.endswith(": No module named 'zzz'")
    assert hint.startswith("Python can't find a module `zzz`. Is it a file of yours?")


def test_a_cell_that_failed_is_not_run_in_its_older_version(kernel):
    for cell, code in {"setup": SETUP, "answer": ROBOT}.items():
        kernel.run(code, cell)
    assert "'time'" in kernel.run("run(Robot, seconds=1).ended.reason", "use")
    assert "SyntaxError" in kernel.run(ROBOT.replace("):", ")", 1), "answer")
    words = (
        "Your last version did not run: the cell with Robot ended with SyntaxError: expected ':' (line 1). "
        "Fix that cell and run it; then run this one again."
    )
    for door in ("run", "play"):
        assert kernel.run(f"{door}(Robot, seconds=1)", "use").strip() == words


def test_an_interrupt_in_our_own_code_is_one_line_and_in_the_users_it_shows_where(kernel):
    kernel.run(SETUP, "setup")
    raises = """
import sim.suggestions
def stop(*more): raise KeyboardInterrupt
sim.suggestions.closest_match = stop
sim.suggestions.unknown_name("a", "b", ["c"])"""
    assert kernel.run(raises, "use").strip() == "KeyboardInterrupt: You interrupted this cell."
    own = kernel.run("def mine():\n    raise KeyboardInterrupt\nmine()", "use")
    assert "mine" in own and "You interrupted" not in own


def test_a_package_that_the_course_itself_lacks_is_no_interrupt(kernel):
    kernel.run(SETUP, "setup")
    lacks = """
import sim.suggestions
def lacking(*more): import zzz
sim.suggestions.closest_match = lacking
sim.suggestions.unknown_name("a", "b", ["c"])"""
    shown = kernel.run(lacks, "use")
    assert "No module named 'zzz'" in shown and "You interrupted" not in shown


def test_a_misspelt_class_and_an_object_for_a_class_are_named_in_one_line(kernel):
    for cell, code in {"setup": SETUP, "answer": ROBOT}.items():
        kernel.run(code, cell)
    shown = kernel.run("run(Robbot, seconds=1)", "use").strip()
    assert shown == "NameError: There is no `Robbot`. Did you mean `Robot`?"
    assert kernel.run("run(Robot(), seconds=1)", "use").strip() == (
        "NotInitializedException: Robot() creates the node here, outside a run. Pass the "
        "class, without parentheses: run(Robot), not run(Robot()); the run creates the node."
    )


def test_an_argument_that_the_course_refuses_is_shown_with_the_users_lines_alone(kernel):
    kernel.run(SETUP, "setup")
    for code, why in (("run(Node, world='romm')", "Did you mean 'room'?"), ("run('A')", "without quotes")):
        said = kernel.run(code, "use")
        assert why in said and "File" not in said and "line 1" in said
    assert "session.py" not in kernel.run("[][2]", "use")


def test_outside_a_notebook_nothing_is_watched():
    values = "n.in_notebook(), n.find_outdated([n]), n.explain_missing_name('n') == ''"
    code = f"from sim import notebook as n; print({values})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout.split() == ["False", "None", "True"]
