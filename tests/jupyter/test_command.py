"""The command ros2-course of an installed course."""

import sys
from pathlib import Path

import pytest

from grader.course_files.work_folder import CHOSEN, student_files
from ros2_course import command as course_command
from ros2_course.command import FILES, main


@pytest.fixture(autouse=True)
def environment(monkeypatch):
    """Restored afterwards; nothing is started."""
    monkeypatch.setenv(CHOSEN, "")
    monkeypatch.setattr(course_command.subprocess, "run", lambda command, check: None)


@pytest.fixture
def lacks(monkeypatch):
    """Lets this machine lack modules and programs."""

    def take(*names: str) -> None:
        find, which = course_command.importlib.util.find_spec, course_command.which
        monkeypatch.setattr(
            course_command.importlib.util, "find_spec", lambda name: None if name in names else find(name)
        )
        monkeypatch.setattr(
            course_command, "which", lambda name: None if name in names else name and which("sh")
        )

    return take


def test_copy_writes_the_notebooks_and_leaves_a_students_work(tmp_path, capsys):
    folder = tmp_path / "a" / "course of mine"
    assert main(["copy", str(folder)]) == 0
    expected = f"The notebooks are in {folder}: start with course/00_robot/lesson.ipynb.\n"
    assert capsys.readouterr().out == expected
    copied = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
    assert copied >= {path.relative_to(FILES) for path in student_files(FILES)}
    own = folder / "exercises" / "01_nodes" / "nodes.ipynb"
    own.write_text("mine")
    assert main(["copy", str(folder)]) == 0
    assert own.read_text() == "mine"


def test_lab_opens_the_folder_with_the_courses_settings(tmp_path, monkeypatch):
    started = []
    monkeypatch.setattr(course_command.os, "execve", lambda *words: started.append(words) or 0)
    with pytest.raises(TypeError):  # execve never returns
        main(["lab", str(tmp_path)])
    ((program, words, variables),) = started
    assert (program, words) == (sys.executable, [sys.executable, "-m", "jupyterlab"])
    assert variables["JUPYTER_CONFIG_PATH"] == str(FILES / "jupyter")
    assert (variables[CHOSEN], variables["PYTHONHASHSEED"]) == (str(tmp_path), "0")


def test_lab_without_jupyterlab_says_how_to_get_it_and_what_works_without(tmp_path, lacks, capsys):
    lacks("jupyterlab")
    assert main(["lab", str(tmp_path)]) == 1
    assert capsys.readouterr().err == (
        "`ros2-course lab` needs JupyterLab, which is not installed: run "
        f"`pip install 'ros2-notebook-course[lab]'`, or `ros2-course copy {tmp_path}`, and open the "
        "notebooks in the front end that you have.\n"
    )


def test_check_finds_nothing_where_all_is_there(lacks, capsys):
    lacks()
    assert main(["check"]) == 0
    assert capsys.readouterr().out == "Nothing is missing.\n"


def test_check_says_what_is_missing_for_what_and_how_to_get_it(lacks, capsys):
    lacks("jupyterlab", "colcon_core", "g++", "bwrap")
    assert main(["check"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "jupyterlab is missing, for the robot beside the code, Validate and the start page: "
        "run `pip install 'ros2-notebook-course[lab]'`.",
        "colcon_core is missing, for building packages in lesson 11: "
        "run `pip install 'ros2-notebook-course[lab]'`.",
        "g++ is missing, for packages with messages of your own, in lesson 11: "
        "run `apt install build-essential python3-dev`.",
        "bwrap is missing, for the league, which runs several versions of your robot: "
        "run `apt install bubblewrap`.",
    ]


def test_check_fails_where_no_robot_can_drive(lacks, capsys, monkeypatch):
    lacks("lidar_rays")
    assert main(["check"]) == 1
    assert capsys.readouterr().err == (
        "lidar_rays is missing, without which nothing runs: "
        "run `pip install --force-reinstall ros2-notebook-course`.\n"
    )
    lacks("rclpy")
    monkeypatch.setattr(course_command.platform, "system", lambda: "Darwin")
    monkeypatch.setattr(course_command.platform, "machine", lambda: "arm64")
    assert main(["check"]) == 1
    assert capsys.readouterr().err == (
        "rclpy is published for Linux x86_64 only, and this machine is Darwin arm64: "
        "use WSL 2 on Windows, or the container of the course.\n"
    )


def test_a_kernel_elsewhere_enters_the_notebooks_folder_with_the_files_beside_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", ["/content"])
    monkeypatch.setattr(course_command, "HERE", FILES)  # as in a wheel
    course_command.enter("course/00_robot")
    assert Path.cwd() == tmp_path / "ros2-course" / "course" / "00_robot"
    assert Path("goal.py").exists() and sys.path == ["", "/content"]


def test_a_kernel_that_is_in_the_folder_stays_there(tmp_path, monkeypatch):
    folder = tmp_path / "course" / "00_robot"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    monkeypatch.setattr(course_command, "HERE", FILES)
    course_command.enter("course/00_robot")
    assert Path.cwd() == folder and list(tmp_path.rglob("*")) == [tmp_path / "course", folder]


def test_a_clone_copies_nothing_where_it_marks_a_services_notebook(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    course_command.enter("exercises/01_nodes")
    assert Path.cwd() == tmp_path and list(tmp_path.iterdir()) == []
