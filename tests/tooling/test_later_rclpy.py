"""The script that tries other releases of rclpy: what it says of a copy in which a name is another one."""

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

from sim.distro import DISTRO
from sim.ros.hooks.verify import RCLPY_OF, WRITTEN_FOR

ROOT = Path(__file__).parents[2]
INSTALLED = Path(importlib.util.find_spec("rclpy").submodule_search_locations[0])


def later_rclpy(*words):
    command = [sys.executable, "-m", "tests.later_rclpy", *map(str, words)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def test_a_renamed_attribute_and_a_missing_error_are_named(tmp_path):
    shutil.copytree(INSTALLED, tmp_path / "rclpy", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    (tmp_path / "package.xml").write_text("<package>\n  <version>7.1.99</version>\n</package>\n")
    executors = tmp_path / "rclpy" / "executors.py"
    text = executors.read_text().replace("self._tasks", "self._all_tasks")
    executors.write_text(text + "\nNewError = _rclpy.NewError\n")
    done = later_rclpy(tmp_path)
    header, row, words = done.stdout.splitlines()
    assert header.split() == ["rclpy", "equal", "recordings", "missing", "in", "the", "compiled", "layer"]
    release, none, of, scenarios, missing = row.split()
    assert (release, none, of, missing) == ("7.1.99", "0", "of", "NewError")
    assert int(scenarios) > 20
    assert words == (
        "7.1.99: HookError: A run uses rclpy.executors.Executor._tasks, which rclpy "
        f"{RCLPY_OF[DISTRO]} does not have, or has with other arguments: this course was written for rclpy "
        f"{WRITTEN_FOR['rclpy']}."
    )
    assert done.returncode == 1


def test_another_folder_is_named(tmp_path):
    done = later_rclpy(tmp_path)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == (
        f"python -m tests.later_rclpy: error: {tmp_path} is no checkout of rclpy: "
        "it has no rclpy/executors.py"
    )
