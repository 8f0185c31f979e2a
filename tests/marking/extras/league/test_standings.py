import pytest

from grader.marking.extras.league.contest import Contest, Game
from grader.marking.extras.league.standings import REFERENCE, anonymous_names, standings
from grader.marking.result import CellResult, NotebookResult, Result

TWO = Contest("words", 2, 60.0)
WRONG = "Something went wrong in 1 of 2 warehouses, first in 2."
STOPPED = "Stopped in warehouse 2: from there on, nothing counts."


def game(**changes) -> Game:
    figures = {"delivered": 1, "orders": 3, "people": 0, "contacts": 0, "waited": 20.0, "way": 5.0}
    return Game(**{**figures, "digest": "d", "replay": "", "why": "", **changes})


def result(student: str, *games: Game, reason: str = "") -> Result:
    cell = CellResult("deliver", "deliver", 0.0, 0.0, games=[each.as_dict() for each in games])
    notebook = NotebookResult("robot", {"cells": []}, [cell])
    return Result(student, "13_robot", "k", "marked", reason, notebooks=[notebook])


def table(*results: Result) -> list[tuple[int, str]]:
    names = {result.student: result.student for result in results}
    return [(row.rank, row.student) for row in standings(results, TWO, names)]


def test_deliveries_come_first_then_people_then_other_contacts_then_time():
    assert table(
        result("slow", game(), game(waited=30.0)),
        result("bumps", game(contacts=1), game(waited=1.0)),
        result("meets", game(people=1), game(waited=1.0)),
        result("more", game(), game(delivered=2, people=3, contacts=9)),
        result("fast", game(), game()),
    ) == [(1, "more"), (2, "fast"), (3, "slow"), (4, "bumps"), (5, "meets")]


def test_who_did_not_play_to_the_end_comes_after_those_with_as_many_deliveries():
    bumps = result("bumps", game(contacts=7), game(delivered=0))
    assert table(result("none"), result("half", game()), bumps) == [(1, "bumps"), (2, "half"), (3, "none")]


def test_equal_robots_share_a_place_and_the_reference_has_none():
    assert table(
        result("b", game(), game()),
        result("c", game(), game(delivered=0)),
        result(REFERENCE, game(delivered=9), game()),
        result("a", game(), game()),
    ) == [(0, REFERENCE), (1, "a"), (1, "b"), (3, "c")]


def test_a_row_has_the_figures_of_all_its_games():
    more = game(delivered=2, waited=10.0, people=1, contacts=2)
    [row] = standings([result("a", game(), more)], TWO, {"a": "x y"})
    figures = row.name, row.delivered, row.orders, row.people, row.contacts, row.pace
    assert figures == ("x y", 3, 6, 1, 2, 10.0)
    [row] = standings([result("a", game(delivered=0, waited=0.0))], TWO, {"a": "x y"})
    assert row.pace is None


@pytest.mark.parametrize(
    ("games", "reason", "note", "why"),
    [
        ([game(), game()], "", "", ""),
        ([game(), game(why="It raised.")], "", WRONG, "It raised."),
        ([game(why="It raised.")], "It ended.", STOPPED, "It ended."),
        ([], "There is no notebook.", "Did not play.", "There is no notebook."),
    ],
)
def test_an_error_is_reported_in_the_course_s_words_and_separately_in_its_own(games, reason, note, why):
    [row] = standings([result("a", *games, reason=reason)], TWO, {"a": "a"})
    assert (row.note, row.why) == (note, why)


def test_names_say_nothing_differ_and_are_the_same_for_the_same_key():
    students = [f"s{number}" for number in range(500)]
    names = anonymous_names([*students, REFERENCE], "key")
    assert len(set(names.values())) == 501
    assert names[REFERENCE] == "the reference"
    assert (names["s0"], names["s1"]) == ("ruby ibis", "olive eagle")
    assert names == anonymous_names([REFERENCE, *reversed(students)], "key")
    assert anonymous_names(students, "another") != anonymous_names(students, "key")
