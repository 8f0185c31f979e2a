import datetime
import json

import pytest

from grader.course_files.review_questions import review_html, review_questions

TODAY = datetime.date(2026, 3, 20)
ANSWERS = {"a": "yes, `x`", "b": "no"}


def saved(course, lesson, **questions):
    """Write predictions of a lesson: question -> days ago, predicted, happened."""
    folder = course / lesson
    folder.mkdir(exist_ok=True)
    entries = {
        question: {
            "answers": ANSWERS,
            "predicted": predicted,
            "on": (TODAY - datetime.timedelta(days)).isoformat(),
            **({"happened": happened} if happened else {}),
        }
        for question, (days, predicted, happened) in questions.items()
    }
    (folder / "predictions.json").write_text(json.dumps(entries), "utf-8")


def asked(course):
    return [question.question for question in review_questions(course, TODAY)]


def test_three_are_asked_those_on_their_day_first_and_wrong_ones_before_right_ones(tmp_path):
    saved(tmp_path, "01_nodes", right=(3, "a", "a"), wrong=(1, "a", "b"), old=(9, "b", "a"))
    saved(tmp_path, "02_topics", older=(12, "b", "a"))
    assert asked(tmp_path) == ["wrong", "right", "older"]


def test_what_was_predicted_today_or_has_no_outcome_is_not_asked(tmp_path):
    saved(tmp_path, "01_nodes", today=(0, "a", "b"), open=(5, "a", None))
    assert asked(tmp_path) == []
    assert review_html([]) == ""


@pytest.mark.parametrize(
    "text", ["", "[]", '{"q": 3}', '{"q": {"answers": {"a": "x"}, "predicted": "b", "happened": "a", "on": "x"}}']
)
def test_a_damaged_file_asks_nothing(tmp_path, text):
    (tmp_path / "01_nodes").mkdir()
    (tmp_path / "01_nodes/predictions.json").write_text(text)
    assert asked(tmp_path) == []


def test_a_question_shows_its_answers_and_hides_what_happened(tmp_path):
    saved(tmp_path, "01_nodes", **{"Is 1 < 2?": (3, "a", "b")})
    page = review_html(review_questions(tmp_path, TODAY))
    assert page == (
        "<h2>Do you remember?</h2>\n<details><summary>Is 1 &lt; 2?</summary>"
        "<ul><li>a yes, <code>x</code></li><li>b no</li></ul>"
        "<details><summary>What happened</summary><p><b>b</b> no. You predicted a, in"
        ' <a href="01_nodes/lesson.ipynb">01_nodes</a>.</p></details></details>\n'
    )


def test_the_link_leads_to_the_notebook_that_asks_the_question(tmp_path):
    saved(tmp_path, "bridge", **{"Is 1 < 2, or not?": (3, "a", "b")})
    source = ["guess = predict(\n", '    "Is 1 < 2, "\n', '    "or not?", a="yes", b="no"\n', ")"]
    for name, lines in (("01_ros1", ["predict(1)"]), ("02_gazebo", source), ("03_control", ["predict("])):
        cells = [{"cell_type": "code", "source": lines}]
        (tmp_path / f"bridge/{name}.ipynb").write_text(json.dumps({"cells": cells}), "utf-8")
    assert '<a href="bridge/02_gazebo.ipynb">bridge</a>' in review_html(review_questions(tmp_path, TODAY))
    (tmp_path / "bridge/01_ros1.ipynb").write_text("<<<", "utf-8")
    assert '<a href="bridge/02_gazebo.ipynb">bridge</a>' in review_html(review_questions(tmp_path, TODAY))
