"""How long each lesson takes, and how deep its classes inherit."""

import json
from dataclasses import replace

import pytest

from tests.tooling.lesson_times import DEEPEST, LIMIT, count, lessons

NEAR = 10  # minutes between the time that a lesson shows and its estimate


def notebook(tmp_path, *cells):
    """A notebook with these cells; Markdown begins with "#"."""
    kinds = [("markdown" if source.startswith("#") else "code", source) for source in cells]
    path = tmp_path / "lesson.ipynb"
    path.write_text(json.dumps({"cells": [{"cell_type": kind, "source": [text]} for kind, text in kinds]}))
    return count(path)


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_a_lesson_shows_the_time_that_it_takes(lesson):
    problem = f"about {lesson.minutes:.0f} minutes by python -m tests.tooling.lesson_times"
    assert abs(lesson.shown_minutes - lesson.minutes) <= NEAR, f"{lesson.name} shows another time: {problem}"


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_a_lesson_fits_in_one_sitting(lesson):
    assert max(lesson.minutes, lesson.shown_minutes) <= LIMIT


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_something_moves_in_every_lesson(lesson):
    assert lesson.moves


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.name)
def test_a_class_that_is_built_in_pieces_has_few_of_them(lesson):
    assert lesson.depth <= DEEPEST


def test_everything_that_takes_time_is_counted(tmp_path):
    (tmp_path / "whole.py").write_text("class Base:\n    x = 1\n\n\nclass A(Base):\n    pass\n")
    text = "# A\n\n**Time:** about\n75 minutes. Two words.\n\n```\nros2 run a b\n```\n\n"
    text += "**Try it yourself.** <details>"
    code = "import whole\nprint(inspect.getsource(whole.Base))\n\n\nclass B(whole.A):\n    y = 2\n"
    found = notebook(
        tmp_path, text, code, "live = play(B)\ninteract(f)", "guess = predict(1)", "!colcon build"
    )
    assert found == replace(
        found, name=f"{tmp_path.name}/lesson", shown="about 75 minutes", words=10, lines=8, cells=3, tries=1,
        questions=2, plays=1, sliders=1, builds=1, terminals=1, classes=1, depth=3,
    )  # fmt: skip
    assert found.minutes == pytest.approx(10 / 120 + 0.8 + 1.2 + 5 + 2 + 3 + 2 + 0.5 + 4)
    assert found.shown_minutes == 75


def test_a_time_in_another_form_is_reported(tmp_path):
    with pytest.raises(ValueError, match="expected “about 75 minutes”, saw “an hour”"):
        _ = notebook(tmp_path, "# A\n\n**Time:** an hour.").shown_minutes
