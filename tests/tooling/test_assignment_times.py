"""How long each assignment takes a student."""

import json

import pytest

from tests.tooling.assignment_times import LIMIT, assignments, count

NEAR = 20  # minutes that an assignment may show less than its estimate
ALL = assignments()


@pytest.mark.parametrize("tasks", ALL, ids=lambda tasks: tasks.name)
def test_an_assignment_shows_the_time_that_it_takes(tasks):
    problem = f"about {tasks.minutes:.0f} minutes by python -m tests.tooling.assignment_times"
    assert tasks.shown_minutes >= tasks.minutes - NEAR, f"{tasks.name} shows less: {problem}"


def test_an_assignment_takes_two_and_a_half_hours_at_most():
    assert [tasks.name for tasks in ALL if max(tasks.shown_minutes, tasks.minutes) > LIMIT] == []


def test_what_takes_a_student_time_is_counted(tmp_path):
    cells = [
        ("markdown", "# A\n\n**Time:** about two and three\nquarter hours. It calls `colcon build`.", {}),
        ("code", "x = 1\n### BEGIN SOLUTION\ny = 2\n\nz = 3\n### END SOLUTION", {}),
        ("code", "%%writefile a/b.xml\n### BEGIN SOLUTION\n<b/>\n### END SOLUTION", {}),
        ("code", "topics.a.grade(A)", {"nbgrader": {"grade": True}}),
    ]
    path = tmp_path / "a.ipynb"
    data = [{"cell_type": kind, "source": [text], "metadata": more} for kind, text, more in cells]
    path.write_text(json.dumps({"cells": data}))
    found = count(path)
    assert (found.words, found.given, found.answers, found.settings) == (12, 2, 2, 1)
    assert (found.exercises, found.builds, found.shown_minutes) == (1, 1, 165.0)
    assert found.minutes == pytest.approx(0.1 + 0.2 + 2 + 0.4 + 7 + 2)
    path.write_text(path.read_text().replace("about two", "about 2"))
    message = "expected “about two and a half hours”, saw “about 2 and three quarter hours”"
    with pytest.raises(ValueError, match=message):
        _ = count(path).shown_minutes
