"""`python -m grader variants`: each student's own notebooks, in folders and in ZIPs."""

import shutil
import zipfile
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook

from grader.__main__ import main
from grader.exercises import nodes
from grader.marking.gradebook.course import Course
from grader.marking.release.handout import assignments_with_variants
from grader.marking.release.make_exercises import release
from grader.marking.submission.plain_cells import cell_of
from grader.seeds import secret_of_student
from grader.variants import drawn_number
from tests.marking.tiny import ROOT

NAME = "01_nodes"
VARIED = ("counter", "battery", "heart", "weather")


@pytest.fixture(scope="module")
def released(tmp_path_factory) -> Path:
    """A course with assignment 1 in variants, and with a secret; made once, for nbgrader takes its time."""
    folder = tmp_path_factory.mktemp("course")
    shutil.copytree(ROOT / "solutions" / NAME, folder / "solutions" / NAME)
    shutil.copy(ROOT / "nbgrader_config.py", folder)
    (folder / "class").mkdir()
    (folder / "class" / "course.toml").write_text(f'["{NAME}"]\nvariants = true\n')
    release(folder)
    (folder / ".secret").touch(mode=0o600)
    (folder / ".secret").write_text("d1ce\n")
    return folder


@pytest.fixture
def course(released, tmp_path, monkeypatch) -> Course:
    """A copy of it for one test, which runs in its folder."""
    folder = tmp_path / "course"
    shutil.copytree(released, folder)
    monkeypatch.chdir(folder)
    return Course(folder)


def says(capsys, *words: str) -> tuple[int, str, str]:
    """The status of the command, and what it prints."""
    status = main(["variants", *words])
    printed = capsys.readouterr()
    return status, printed.out, printed.err


def texts(path: Path) -> dict[str, str]:
    return {cell.id: cell.source for cell in nbformat.read(path, 4).cells}


def test_each_student_has_the_own_variants(course, capsys):
    status, output, wrong = says(capsys, NAME, "--student", "ann", "--student", "bob")
    assert (status, output, wrong) == (0, f"class/variants/STUDENT/{NAME}/: 2 students\n", "")
    place = course.root / "class" / "variants"
    found = [texts(place / student / NAME / "nodes.ipynb") for student in ("ann", "bob")]
    assert found[0] != found[1]
    for student, text in zip(("ann", "bob"), found, strict=True):
        own = secret_of_student("d1ce", student)
        for name in VARIED:
            number = drawn_number(own, name, getattr(nodes, name).variants.count)
            assert text[f"{name}-points"].startswith(f"nodes.{name}.variant({number}).grade(")
        assert text["hello-points"] == "nodes.hello.grade(Hello)"
        assert "SOLUTION" not in "".join(text.values())


def test_it_is_normalized_and_has_nbgrader_s_checksums(course, capsys):
    assert says(capsys, NAME, "--student", "ann")[0] == 0
    path = course.root / "class" / "variants" / "ann" / NAME / "nodes.ipynb"
    cells = [cell_of(cell) for cell in nbformat.read(path, 4).cells]
    assert all(cell.settings["checksum"] == cell.checksum for cell in cells if cell.name)
    before = path.read_bytes()
    assert main(["variants", NAME, "--student", "ann"]) == 0
    assert path.read_bytes() == before


def test_everyone_in_the_gradebook_or_in_a_file_gets_one(course, capsys):
    with Gradebook(course.database, course.name) as book:
        book.update_or_create_student("carl")
        book.update_or_create_student("dora")
    assert says(capsys, NAME)[:2] == (0, f"class/variants/STUDENT/{NAME}/: 2 students\n")
    assert sorted(path.name for path in (course.root / "class" / "variants").iterdir()) == ["carl", "dora"]
    Path("names.txt").write_text("eve@example.org\n\n fred \n")
    assert says(capsys, NAME, "--students", "names.txt")[0] == 0
    assert (course.root / "class" / "variants" / "eve@example.org" / NAME / "nodes.ipynb").exists()
    assert (course.root / "class" / "variants" / "fred" / NAME / "nodes.ipynb").exists()


def test_a_zip_is_unpacked_in_the_course_s_folder(course, capsys):
    assert says(capsys, NAME, "--student", "ann")[0] == 0
    expected = f"class/variants/STUDENT/{NAME}.zip: 1 student\n"
    assert says(capsys, NAME, "--student", "ann", "--zip") == (0, expected, "")
    place = course.root / "class" / "variants" / "ann"
    with zipfile.ZipFile(place / f"{NAME}.zip") as archive:
        assert archive.namelist() == [f"exercises/{NAME}/nodes.ipynb"]
        assert archive.read(archive.namelist()[0]) == (place / NAME / "nodes.ipynb").read_bytes()


def test_answers_follow_and_lie_where_no_student_s_folder_is(course, capsys):
    expected = f"class/variants-answers/STUDENT/{NAME}/: 1 student\n"
    assert says(capsys, NAME, "--student", "ann", "--answers") == (0, expected, "")
    text = texts(course.root / "class" / "variants-answers" / "ann" / NAME / "nodes.ipynb")
    number = drawn_number(secret_of_student("d1ce", "ann"), "counter", nodes.counter.variants.count)
    values = nodes.counter.variants.values(number)
    assert f"self.create_timer({values['period']:g}, self.tick)" in text["counter"]
    assert f'"{values["word"]}: {{self.count}}"' in text["counter"]
    assert not (course.root / "class" / "variants").exists()


def test_no_handout_has_the_common_notebook(course):
    assert assignments_with_variants(course.root) == [NAME]
    assert assignments_with_variants(ROOT) == []


def test_without_a_secret_it_says_what_to_do(course, capsys):
    (course.root / ".secret").unlink()
    why = "which are drawn from the class's secret, and there is no secret: create it as grader/README.md"
    expected = f"No variants: {NAME} has variants, {why} says.\n"
    assert says(capsys, NAME, "--student", "ann") == (1, "", expected)


def test_without_variants_it_says_how_to_have_them(course, capsys):
    (course.root / "class" / "course.toml").unlink()
    release(course.root)
    expected = f"expected `variants = true` below ['{NAME}'] in class/course.toml and then `make exercises`"
    why = f"No variants: {expected}, saw no variants in exercises/{NAME}.\n"
    assert says(capsys, NAME, "--student", "ann") == (1, "", why)


def test_without_a_release_it_says_what_to_run(course, capsys):
    why = "expected an assignment in exercises/99_none, saw no notebook: run `make exercises` first"
    assert says(capsys, "99_none") == (1, "", f"No variants: {why}.\n")


def test_without_students_it_says_how_to_name_them(course, capsys):
    why = "expected --student NAME or --students FILE, because the gradebook has no students"
    assert says(capsys, NAME) == (1, "", f"No variants: {why}.\n")


@pytest.mark.parametrize("name", ["a/b", "../ann", ".ann", "x\0"])
def test_a_name_that_can_t_be_a_folder_is_refused(course, capsys, name):
    why = f"expected the name of a student, without `/` and no dot first, saw {name!r}"
    assert says(capsys, NAME, "--student", name) == (1, "", f"No variants: {why}.\n")
    assert not (course.root / "class" / "variants").exists()


def test_a_file_that_can_t_be_read_or_written_is_named(course, capsys):
    why = "No variants: names.txt could not be read or written (No such file or directory).\n"
    assert says(capsys, NAME, "--students", "names.txt") == (1, "", why)
    (course.root / "class" / "variants").write_text("in the way")
    status, _, wrong = says(capsys, NAME, "--student", "ann")
    assert status == 1
    assert wrong.endswith("could not be read or written (Not a directory).\n")
