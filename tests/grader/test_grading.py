import asyncio

import pytest

from grader.exercise import Exercise
from grader.grading import Grading, current_grading, graded_as


@pytest.mark.parametrize("secret", ["", "hush"])
def test_a_process_judges_by_itself_with_the_secret_of_its_environment(monkeypatch, secret):
    monkeypatch.setenv("COURSE_SECRET", secret)
    assert current_grading() == Grading(secret=secret, hand_over=None)


def test_where_nodes_are_handed_over_grade_gives_name_and_nodes_and_judges_nothing():
    handed_over = []
    exercise = Exercise("talk", "A talker")  # to judge it would raise: it has no checks
    with graded_as(Grading(hand_over=lambda *given: handed_over.append(given))):
        assert exercise.grade("a node", "another") is None
    assert handed_over == [("talk", ("a node", "another"))]


def test_it_holds_in_tasks_that_are_created_inside_and_ends_with_an_error(monkeypatch):
    monkeypatch.delenv("COURSE_SECRET", raising=False)

    async def here():
        return current_grading()

    async def both():
        with pytest.raises(ZeroDivisionError), graded_as(Grading("inside")):
            inside = asyncio.create_task(here())
            1 / 0  # noqa: B018
        return [await inside, await asyncio.create_task(here())]

    assert asyncio.run(both()) == [Grading("inside"), Grading()]
