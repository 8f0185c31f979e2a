"""What a terminal of JupyterLab reads when it opens."""

import os
import subprocess
import sys
from pathlib import Path

from tests.browser.lab import ROOT

COMMAND = ["bash", "--rcfile", str(ROOT / "jupyter" / "terminal.bashrc"), "-i"]


def typed(lines: str, folder: Path, **more: str) -> list[str]:
    """The output of lines typed into a terminal that opens in a folder."""
    path = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path, "HOME": str(folder / "home"), **more}
    ran = subprocess.run(COMMAND, cwd=folder, env=environment, input=lines, capture_output=True, text=True)
    return ran.stdout.splitlines()


def test_ros2_is_completed_and_the_users_own_settings_are_read(tmp_path):
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / ".bashrc").write_text("MINE=yes\n")
    output = typed("complete -p ros2; echo $MINE\n", tmp_path)
    assert output[0].startswith("complete ") and output[0].endswith(" ros2")
    assert output[1] == "yes"


def test_it_opens_in_the_students_files_or_in_the_folder_that_is_shown(tmp_path):
    work, lesson = tmp_path / "work", tmp_path / "work" / "course"
    lesson.mkdir(parents=True)
    folders = {"ROS2_COURSE": str(tmp_path), "JUPYTER_SERVER_ROOT": str(work)}
    assert typed("pwd\n", tmp_path, **folders) == [str(work)]
    assert typed("pwd\n", lesson, **folders) == [str(lesson)]
