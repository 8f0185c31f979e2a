"""Types the exercise of grader/YOUR_FIRST_EXERCISE.md into a course, and marks it as the page says."""
import re
import shlex
import subprocess
import tomllib

import nbformat
import pytest

from grader.marking.command.cli import main as mark
from grader.marking.release.make_exercises import release
from tests.marking.tiny import ROOT, answer, course, grade

TEXT = (ROOT / "grader" / "YOUR_FIRST_EXERCISE.md").read_text(encoding="utf-8")
SETUP, ANSWER, PUBLISHES, COUNTS = re.findall(r"```python\n(.*?)\n```", TEXT, re.S)
COMMANDS = re.search(r"```\n(make exercises.*?)```", TEXT, re.S)[1].splitlines()
TABLE = re.search(r"```text\n(.*?)```", TEXT, re.S)[1]
CHOICE = re.search(r"```toml\n(.*?)```", TEXT, re.S)[1]
POINTS = {name: int(points) for name, points in re.findall(r"ID `([a-z-]+)` and (\d+) points", TEXT)}


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A course with the assignment that the page describes, released."""
    folder = course(
        tmp_path / "course",
        nbformat.v4.new_code_cell(SETUP, id="setup"),
        answer("talker", ANSWER),
        grade("talker-publishes", POINTS["talker-publishes"], PUBLISHES),
        grade("talker-counts", POINTS["talker-counts"], COUNTS),
    )
    made = (folder / "solutions" / "01_tiny").rename(folder / "solutions" / "my_first")
    (made / "tiny.ipynb").rename(made / "first.ipynb")
    monkeypatch.chdir(folder)
    release(folder)
    return folder


def test_the_exercise_of_the_page_is_marked_as_the_page_says(own, capsys):
    first, second, *copies, last = (line.partition("#")[0].strip() for line in COMMANDS)
    assert (first, second) == ("make exercises", ". .venv/bin/activate")
    assert last == "python -m grader mark my_first"
    for command in copies:
        subprocess.run(shlex.split(command), check=True)
    half = own / "class" / "submitted" / "half" / "my_first" / "first.ipynb"
    half.parent.mkdir(parents=True)
    half.write_text((own / "solutions/my_first/first.ipynb").read_text().replace("timer(0.5", "timer(1.0"))
    assert mark(["my_first", "--student", "right", "--student", "empty"]) == 0
    assert capsys.readouterr().out.startswith(TABLE)
    assert mark(["my_first", "--student", "half"]) == 0
    assert "half                    4              4      8   marked\n" in capsys.readouterr().out
    hint = "Expected 6 messages in 3 s, saw 3. Hint: the period of a timer is 1 / rate."
    assert hint in (own / "class" / "feedback" / "half" / "my_first" / "first.html").read_text()
    page = (own / "class" / "feedback" / "empty" / "my_first" / "first.html").read_text()
    assert "Hint: create a publisher on /chatter, and a timer whose callback publishes." in page


def test_the_choice_of_the_page_fits_the_course():
    from grader.marking.release.own_choice import choose

    for name, choice in tomllib.loads(CHOICE).items():
        for path in (ROOT / "solutions" / name).glob("*.ipynb"):
            assert len(choose(nbformat.read(path, 4), choice, name).cells) > len(choice["leave_out"])


@pytest.mark.parametrize("name", ["solutions/my_first/a", "exercises/my_first/a", "class/course.toml"])
def test_git_ignores_what_belongs_to_the_instructor(name):
    assert subprocess.run(["git", "check-ignore", "-q", name], cwd=ROOT).returncode == 0
