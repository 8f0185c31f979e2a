"""python -m tests.exercises: what it refuses, and in which words."""

import shutil
from pathlib import Path

import pytest

from tests.exercises.__main__ import main, place_of
from tests.exercises.new_exercise import write_new

ROOT = Path(__file__).parents[2]
TOPICS = ", ".join(path.name.partition("_")[2] for path in sorted(ROOT.glob("solutions/[01]*")))
EXERCISES = ", ".join(
    f"{path.parts[-3]}/{path.parts[-2]}" for path in sorted(ROOT.glob("tests/exercises/*/*/students.py"))
)


@pytest.fixture
def course(tmp_path):
    """A course with the assignment of topics, and with one exercise."""
    shutil.copytree(ROOT / "solutions/02_topics", tmp_path / "solutions/02_topics")
    (tmp_path / "grader/exercises/topics").mkdir(parents=True)
    (tmp_path / "tests/exercises/topics").mkdir(parents=True)
    list(write_new(tmp_path, "topics", "battery"))
    return tmp_path


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    ("topic", "name", "error", "words"),
    [
        ("topic", "imu", LookupError,
         "There is no topic 'topic'. Did you mean 'topics'? The topics are topics."),
        ("topics", "2nd", LookupError,
         "expected a name in lower case, such as battery_level, and not '2nd'"),
        ("topics", "Imu", LookupError,
         "expected a name in lower case, such as battery_level, and not 'Imu'"),
        ("topics", "battery", FileExistsError,
         "grader/exercises/topics/battery.py is already there: choose another name"),
    ],
)  # fmt: skip
def test_a_refused_exercise_changes_nothing(course, topic, name, error, words):
    before = contents(course)
    with pytest.raises(error) as raised:
        list(write_new(course, topic, name))
    assert str(raised.value) == words
    assert contents(course) == before


@pytest.mark.parametrize(
    ("there", "words"),
    [
        ("grader/exercises/topics/imu/x",
         "grader/exercises/topics/imu is already there: choose another name"),
        ("tests/exercises/topics/imu/students.py",
         "tests/exercises/topics/imu/students.py is already there: choose another name"),
    ],
)  # fmt: skip
def test_a_part_of_an_exercise_is_in_the_way_as_well(course, there, words):
    (course / there).parent.mkdir()
    (course / there).touch()
    with pytest.raises(FileExistsError) as raised:
        list(write_new(course, "topics", "imu"))
    assert str(raised.value) == words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["square", "deliver"], "expected the name of one exercise, or --new TOPIC NAME"),
        (["--new", "topics"], "expected the name of one exercise, or --new TOPIC NAME"),
        (["--new", "topic", "imu"],
         f"There is no topic 'topic'. Did you mean 'topics'? The topics are {TOPICS}."),
        (["nowhere/square"], f"There is no exercise 'nowhere/square'. The exercises are {EXERCISES}."),
        (["square"], "several exercises are called square: write actions/square or topics/square"),
    ],
)  # fmt: skip
def test_the_command_line_ends_with_one_sentence(capsys, arguments, words):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"python -m tests.exercises: error: {words}"


def test_a_name_that_only_one_exercise_has_needs_no_topic():
    assert place_of("navigate") == place_of("navigating/navigate") == ("navigating", "navigate")
