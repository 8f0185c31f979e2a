import pytest

import grader
from grader.catalog import exercises
from tests.students import misfits


def test_the_door_has_these_names():
    names = ["Exercise", "Missed", "Scenario", "Score", "check", "course_map", "grade", "tell"]
    assert grader.__all__ == names
    assert all(hasattr(grader, name) for name in grader.__all__)


def test_every_exercise_is_found_by_its_name():
    found = exercises()
    assert len(found) >= 8
    assert all(exercise.name == name for name, exercise in found.items())
    assert list(found) == sorted(found)


def test_grade_takes_the_exercise_or_its_name():
    name, exercise = next(iter(exercises().items()))
    by_name, by_object = grader.grade(name, misfits.Empty), grader.grade(exercise, misfits.Empty)
    assert by_name.as_dict() == by_object.as_dict()
    assert by_name.exercise == name


def test_an_unknown_name_is_answered_with_the_nearest():
    name = next(iter(exercises()))
    with pytest.raises(LookupError) as caught:
        grader.grade(name + "s", misfits.Empty)
    assert str(caught.value) == (
        f"There is no exercise '{name}s'. Did you mean '{name}'? The exercises are {', '.join(exercises())}."
    )


def test_a_name_like_no_other_gets_the_list():
    with pytest.raises(LookupError, match=r"^There is no exercise '\?'\. The exercises are "):
        grader.grade("?", misfits.Empty)


def test_two_exercises_of_one_name_are_refused(monkeypatch, tmp_path):
    for module in ("first_twin", "second_twin"):
        (tmp_path / f"{module}.py").write_text(
            "from grader import Exercise, check\n"
            "@check(points=1)\ndef runs(recording):\n    'It runs.'\n"
            "twin = Exercise('twin', 'A twin', checks=[runs])\n"
        )
    monkeypatch.setattr(grader.exercises, "__path__", [str(tmp_path)])
    with pytest.raises(
        ValueError, match=r"^two exercises are called 'twin': names must be unique in the course$"
    ):
        exercises.__wrapped__()
