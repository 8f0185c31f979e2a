import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from traitlets.config import PyFileConfigLoader

from grader.course_files.work_folder import assistant_files, student_files
from grader.marking.release.handout import INCLUDED, NAME, contents, main, makefile, write_folder, write_zip
from tests.marking.tiny import ROOT

GRADE = """
import json, sim, grader
from grader.exercises import nodes
from rclpy.node import Node
class Hello(Node):
    def __init__(self):
        super().__init__("hello")
        self.get_logger().info("Hello, robot!")
score = nodes.hello.grade(Hello)
print(json.dumps([grader.__file__, sim.__file__, score.as_dict()]))
"""


@pytest.fixture(scope="module")
def handout() -> dict[str, bytes]:
    return contents(ROOT)


@pytest.fixture(scope="module")
def folder(handout, tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("handout") / NAME
    write_folder(handout, place)
    return place


def graded(course: Path, place: Path) -> list:
    """What a node gets by the packages in this course."""
    environment = {**os.environ, "PYTHONPATH": str(course)}
    done = subprocess.run(
        [sys.executable, "-c", GRADE], cwd=place, env=environment, check=True, capture_output=True, text=True
    )
    return json.loads(done.stdout.splitlines()[-1])


def test_students_get_lessons_starters_the_robot_and_the_checks(handout):
    assert {name.split("/")[0] for name in handout} == {
        *("AGENTS.md", "COLCON_IGNORE", "LICENSE", "Makefile", "README.md", "TUTOR.md"),
        *("nbgrader_config.py", "pyproject.toml", "requirements.lock"),
        *(".binder", ".ci", ".devcontainer", "jupyter"),
        *("course", "exercises", "grader", "ros_packages", "sim"),
    }
    for top in ("course", "exercises"):
        notebooks = {path.relative_to(ROOT).as_posix() for path in (ROOT / top).glob("*/*.ipynb")}
        assert notebooks and notebooks <= set(handout)
    assert {"grader/checks/motion.py", "sim/world/worlds/room.toml", "sim/world/rays/rays.c"} <= set(handout)


def test_students_get_no_solution_no_test_no_marking_and_nothing_of_a_class(handout):
    kept_back = ("solutions/", "tests/", "class/", "work/", "jupyter/teach/", ".secret")
    assert [name for name in handout if name.startswith(kept_back)] == []
    marking = {name.split("/")[2] for name in handout if name.startswith("grader/marking/")}
    assert marking - {"extras"} == {
        *("build_process", "submission", "judge", "sandbox", "student_process"),
        *("__init__.py", "cores.py", "errors.py", "journal.py", "outputs.py", "pool.py", "preload.py"),
        *("progress_line.py", "result.py", "task.py", "page_templates.py", "version.py", "atomic_file.py"),
    }
    assert [name for name in handout if re.search(r"__pycache__|\.egg-info|checkpoints|/build/", name)] == []


def test_students_get_an_exercise_without_its_answers(handout):
    answers = {path.relative_to(ROOT).as_posix() for path in ROOT.glob("grader/exercises/*/*/answers.py")}
    assert answers and answers.isdisjoint(handout)
    beside = {f"{name.rpartition('/')[0]}/__init__.py" for name in answers}
    assert beside <= set(handout)


def test_the_starters_are_those_of_the_release_where_no_answer_can_be_read(handout):
    released = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / "exercises").glob("*/*")}
    starters = {name: text for name, text in handout.items() if name.startswith("exercises/")}
    assert starters == {name: path.read_bytes() for name, path in released.items()}


def test_equal_courses_give_equal_bytes(handout, tmp_path):
    copy = tmp_path / "course"
    write_folder(handout, copy)
    for left in ("grader/__pycache__/x.pyc", "course/01_nodes/my_robot.py", "class/gradebook.db", ".secret"):
        (copy / left).parent.mkdir(exist_ok=True)
        (copy / left).write_text("x")
    shutil.copy(ROOT / "Makefile", copy)
    shutil.copy(ROOT / "course" / "README.md", copy / "course")
    lesson = copy / "course" / "01_nodes" / "lesson.ipynb"
    ran = json.loads(lesson.read_text())
    ran["cells"][1]["execution_count"] = 3  # someone ran it
    lesson.write_text(json.dumps(ran))
    again = contents(copy)
    assert [name for name in again if again[name] != handout.get(name)] == []
    assert write_zip(handout, tmp_path / "a.zip") == write_zip(again, tmp_path / "b.zip")


def test_the_zip_holds_the_folder_and_the_set_up_can_be_run(handout, tmp_path, folder):
    write_zip(handout, tmp_path / "a.zip")
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        assert {info.filename: archive.read(info) for info in archive.infolist()} == {
            f"{NAME}/{name}": text for name, text in handout.items()
        }
        assert archive.getinfo(f"{NAME}/.ci/setup").external_attr >> 16 == 0o100755
    assert os.access(folder / ".ci" / "setup", os.X_OK)


def test_a_node_gets_the_same_score_there(folder, tmp_path):
    there, here = graded(folder, tmp_path), graded(ROOT, tmp_path)
    assert there[:2] == [str(folder / "grader/__init__.py"), str(folder / "sim/__init__.py")]
    assert here[:2] == [str(ROOT / "grader/__init__.py"), str(ROOT / "sim/__init__.py")]
    assert there[2] == here[2]
    assert there[2]["points"] == 10


def test_make_lab_there_is_what_it_is_here(folder):
    def planned(course: Path) -> str:
        command = ["make", "--dry-run", "-o", ".venv/.requirements", "-o", ".venv/.interfaces", "lab"]
        environment = {**os.environ, "MAKEFLAGS": ""}
        output = subprocess.check_output(command, cwd=course, env=environment, text=True)
        return output.replace(str(course), "COURSE")

    assert "JUPYTER_CONFIG_PATH=COURSE/jupyter COURSE/.venv/bin/jupyter-lab" in planned(folder)
    assert planned(folder) == planned(ROOT)


def test_jupyterlab_there_opens_the_same_copies_as_here(folder):
    opened = PyFileConfigLoader("jupyter_server_config.py", path=str(folder / "jupyter")).load_config()
    work = folder / "work"
    assert opened.ServerApp.root_dir == str(work)
    here = {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in student_files(ROOT)}
    there = {path.relative_to(work).as_posix(): path.read_bytes() for path in work.rglob("[!.]*.*")}
    here |= {path.name: path.read_bytes() for path in assistant_files(ROOT)}
    assert there == {name: content for name, content in here.items() if name != "course/README.md"}
    assert (opened.LabApp.default_url, "course/start.ipynb" in there) == ("/lab", True)


def test_a_terminal_of_jupyterlab_there_finds_the_commands_of_the_course(folder, tmp_path, monkeypatch):
    for name, value in {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin", "PYTHONSTARTUP": ""}.items():
        monkeypatch.setenv(name, value)
    opened = PyFileConfigLoader("jupyter_server_config.py", path=str(folder / "jupyter")).load_config()
    shell = opened.ServerApp.terminado_settings["shell_command"]
    asked = [*shell, "-ic", "type -p colcon ros2 python"]
    found = subprocess.run(asked, cwd=tmp_path, check=True, capture_output=True, text=True)
    assert found.stdout.splitlines() == [f"{sys.prefix}/bin/{name}" for name in ("colcon", "ros2", "python")]


def test_make_there_lists_what_students_can_do(folder):
    outside = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    done = subprocess.run(["make"], cwd=folder, env=outside, check=True, capture_output=True, text=True)
    assert [line.split()[0] for line in done.stdout.splitlines()] == ["help", "lab", "setup", "clean"]


def test_what_the_readme_there_names_is_there(handout):
    page = handout["README.md"].decode()
    paths = re.findall(r"`((?:course|exercises|sim)/[\w./]+)`", page)
    assert len(paths) > 2
    assert [path for path in paths if not any(name.startswith(path) for name in handout)] == []


def test_a_new_handout_takes_the_place_of_the_old_one_and_leaves_the_work(tmp_path):
    write_folder({"sim/old.py": b"", "README.md": b"1"}, tmp_path)
    (tmp_path / "work").mkdir()
    (tmp_path / "work" / "mine").write_text("my work")
    write_folder({"sim/new.py": b"", "README.md": b"2"}, tmp_path)
    found = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert found == {"sim/new.py", "README.md", "work/mine"}


def test_rules_go_with_what_belongs_to_them():
    text = "# all\n\nlab: setup  ## open\n\trun\n\nA = b\ntest: tools\n\ttest\n\nC = d\n"
    assert makefile(text) == "# all\n\nlab: setup  ## open\n\trun\n\nC = d\n"


def test_the_command_says_what_it_made_and_refuses_stale_exercises(tiny_course, monkeypatch, capsys):
    monkeypatch.chdir(tiny_course)
    assert main([]) == 1
    assert capsys.readouterr().err == (
        "exercises/01_tiny/tiny.ipynb is missing\nRun `make exercises` first.\n"
    )
    for part in {Path(part).parts[0] for part in (*INCLUDED, "Makefile", "course")} - {"nbgrader_config.py"}:
        (tiny_course / part).symlink_to(ROOT / part)
    shutil.copytree(ROOT / "exercises" / "01_nodes", tiny_course / "exercises" / "01_nodes")
    monkeypatch.setattr("grader.marking.release.handout.differences", lambda course: [])
    assert main(["--to", "out"]) == 0
    output = capsys.readouterr().out
    pattern = r"out/ros2-course/ and out/ros2-course\.zip: \d+ files, \d\.\d MB, SHA-256 [0-9a-f]{64}\n"
    assert re.fullmatch(pattern, output)
