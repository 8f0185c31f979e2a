import json
from pathlib import Path

import nbformat
import pytest

from grader.course_files import work_folder
from grader.course_files.work_folder import student_files, update_work_folder

ROOT = Path(__file__).parents[3]
LESSON = "course/01_nodes/lesson.ipynb"


def notebook(source: str, output: str = "") -> str:
    cell = nbformat.v4.new_code_cell(source, id="a")
    if output:
        cell.outputs = [nbformat.v4.new_output("stream", text=output)]
        cell.execution_count = 7
    return nbformat.writes(nbformat.v4.new_notebook(cells=[cell]))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    for name, text in {
        LESSON: notebook("1"),
        "course/01_nodes/goal.py": "GOAL = 1\n",
        "course/01_nodes/my_robot.py": "written by a cell\n",
        "course/01_nodes/ws/src/my_pkg/setup.py": "of a workspace\n",
        "course/01_nodes/__pycache__/goal.pyc": "",
        "course/README.md": "# Begin\n",
        "exercises/01_nodes/nodes.ipynb": notebook("# your code"),
        "solutions/01_nodes/nodes.ipynb": notebook("the answer"),
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def test_a_user_who_cannot_change_the_course_has_the_copies_in_the_home(course, tmp_path_factory, monkeypatch):
    home = tmp_path_factory.mktemp("home")
    monkeypatch.setattr(work_folder.os, "access", lambda path, mode: False)
    monkeypatch.setenv("HOME", str(home))
    assert update_work_folder(course) == []
    assert (home / "ros2-course" / LESSON).exists() and not (course / "work").exists()


def files(course: Path) -> set[str]:
    return {path.relative_to(course / "work").as_posix() for path in (course / "work").rglob("*.*")}


def test_a_student_gets_copies_of_lessons_and_exercises_and_of_nothing_else(course):
    assert update_work_folder(course) == []
    assert files(course) == {
        ".given.json",
        ".updated.txt",
        LESSON,
        "course/01_nodes/goal.py",
        "course/README.md",
        "exercises/01_nodes/nodes.ipynb",
    }


def test_what_is_unchanged_is_brought_up_to_date_even_if_it_was_run(course):
    update_work_folder(course)
    (course / "work" / LESSON).write_text(notebook("1", output="1"))
    (course / LESSON).write_text(notebook("2"))
    (course / "course/01_nodes/goal.py").write_text("GOAL = 2\n")
    notices = [
        f"{LESSON} was updated: 0 of its 1 cells of code are unchanged and keep their outputs. Run the others."
    ]
    assert update_work_folder(course) == notices
    assert (course / "work/.updated.txt").read_text() == notices[0] + "\n"
    assert (course / "work" / LESSON).read_text() == notebook("2") + "\n"
    assert (course / "work/course/01_nodes/goal.py").read_text() == "GOAL = 2\n"


def test_cells_with_the_same_text_keep_their_outputs_in_an_update(course):
    before, after = nbformat.v4.new_notebook(), nbformat.v4.new_notebook()
    before.cells = [nbformat.v4.new_code_cell(text, id=text) for text in ("one", "two", "three")]
    after.cells = [nbformat.v4.new_code_cell(text, id=text) for text in ("new", "two", "one")]
    after.cells.append(nbformat.v4.new_code_cell("changed", id="three"))
    (course / LESSON).write_text(nbformat.writes(before))
    update_work_folder(course)
    for number, cell in enumerate(before.cells, 1):
        cell.update(outputs=[nbformat.v4.new_output("stream", text=cell.id)], execution_count=number)
    (course / "work" / LESSON).write_text(nbformat.writes(before))
    (course / LESSON).write_text(nbformat.writes(after))
    (notice,) = update_work_folder(course)
    assert "2 of its 4 cells of code are unchanged" in notice
    cells = nbformat.read(course / "work" / LESSON, 4).cells
    shown = [(cell.source, cell.execution_count, [output.text for output in cell.outputs]) for cell in cells]
    assert shown == [("new", None, []), ("two", 2, ["two"]), ("one", 1, ["one"]), ("changed", None, [])]
    assert update_work_folder(course) == []


def test_a_lesson_that_was_not_run_is_updated_without_a_word(course):
    update_work_folder(course)
    (course / LESSON).write_text(notebook("2"))
    assert update_work_folder(course) == []
    assert (course / "work/.updated.txt").read_text() == ""


def test_outputs_stay_as_long_as_there_is_nothing_new(course):
    update_work_folder(course)
    (course / "work" / LESSON).write_text(notebook("1", output="1"))
    assert update_work_folder(course) == []
    assert (course / "work" / LESSON).read_text() == notebook("1", output="1")


def test_a_modified_file_stays_and_the_new_version_is_saved_next_to_it(course):
    update_work_folder(course)
    own, beside = course / "work" / LESSON, course / "work/course/01_nodes/lesson-new.ipynb"
    own.write_text(notebook("my own"))
    assert update_work_folder(course) == []
    (course / LESSON).write_text(notebook("2"))
    assert update_work_folder(course) == [
        "There is a new version of course/01_nodes/lesson.ipynb. Yours stays as it is; "
        "the new one is course/01_nodes/lesson-new.ipynb."
    ]
    assert (own.read_text(), beside.read_text()) == (notebook("my own"), notebook("2"))
    assert update_work_folder(course) == []  # reported once
    (course / LESSON).write_text(notebook("my own"))
    assert update_work_folder(course) == []  # the course has it now
    assert own.read_text() == notebook("my own")


def test_a_file_that_was_deleted_is_given_again(course):
    update_work_folder(course)
    (course / "work" / LESSON).unlink()
    assert update_work_folder(course) == []
    assert (course / "work" / LESSON).read_text() == notebook("1")


def test_a_notebook_that_was_broken_by_hand_counts_as_changed(course):
    update_work_folder(course)
    (course / "work" / LESSON).write_text("{")
    (course / LESSON).write_text(notebook("2"))
    assert len(update_work_folder(course)) == 1
    assert (course / "work" / LESSON).read_text() == "{"


def test_the_record_names_every_file(course):
    update_work_folder(course)
    assert set(json.loads((course / "work/.given.json").read_text())) == files(course) - {
        ".given.json",
        ".updated.txt",
    }


def test_the_courses_own_lessons_and_starters_are_given_and_git_ignores_the_copies():
    given = {path.relative_to(ROOT).as_posix() for path in student_files(ROOT)}
    assert {LESSON, "course/01_nodes/goal.py", "exercises/06_navigator/navigator.ipynb"} <= given
    assert not any(name.startswith("solutions") for name in given)
    assert "\n/work/\n" in (ROOT / ".gitignore").read_text()


def test_the_rules_for_assistants_are_at_the_top_of_the_folder(course):
    (course / "course" / "AGENTS.md").write_text("Be a tutor.")
    assert update_work_folder(course) == []
    assert (course / "work" / "AGENTS.md").read_text() == "Be a tutor."
    (course / "course" / "AGENTS.md").write_text("Be a good tutor.")
    assert update_work_folder(course) == []
    assert (course / "work" / "AGENTS.md").read_text() == "Be a good tutor."


def test_the_start_page_says_what_assistants_may_do():
    cells = json.loads((ROOT / "course/start.ipynb").read_text("utf-8"))["cells"]
    text = "".join(next(cell for cell in cells if cell["id"] == "help")["source"])
    for word in ("**Allowed**", "**Not allowed**", "`AGENTS.md`", "(TUTOR.md)"):
        assert word in text
    assert "(TUTOR.md)" in (ROOT / "course/AGENTS.md").read_text("utf-8")
