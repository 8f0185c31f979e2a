"""What is announced to screen readers: each region with role "status", its texts, and their tests."""

import re
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[2]
WEB, LAB = "sim/view/web", "jupyter/labextensions/ros2-course/static"
REGION = re.compile(r"""role: "status"|"role", "status"|role=["']status""")


class Announcement(NamedTuple):
    """When a text is announced, its script and words, its test, and the words there if they are others."""

    when: str
    script: str
    words: str
    test: str
    sought: str = ""


LIVE, REPLAY, PLOT, CARD, GAME = (
    f"{WEB}/{name}.js" for name in ("live", "replay", "plots", "prediction", "order_game")
)
SUCCESS, PANEL, VALIDATE = (f"{LAB}/{name}.js" for name in ("success", "robot_panel", "validate"))
RESTARTED = "The kernel was restarted, and the robot is gone."
STANDALONE = "../sim/standalone/test_page"
ANNOUNCEMENTS = [Announcement(*row) for row in (
    ("the star is reached", LIVE, "Reached the star in", "test_success_in_lab"),
    ("it took less time than before", LIVE, "Your best time here; before: ", "test_success_in_lab"),
    ("the robot touches something", LIVE, "Contacts: ", "test_robot_sidebar"),
    ("the kernel is busy", LIVE, "The robot waits: the kernel is busy", "test_robot_sidebar"),
    ("the robot's program has ended", LIVE, "ended ? ended[1]", STANDALONE, "The robot's program has ended."),
    ("there is a second robot", LIVE, "warningLine", STANDALONE, "There is a second /robot"),
    ("a replay is at an event", REPLAY, "mark.words", "test_picture_page", "touched a wall with its front"),
    ("the cursor of a plot moves", PLOT, "t = ${time} s", "test_replay_in_lab", "t = 3.50 s"),
    ("a prediction is saved", CARD, "Your prediction is saved.", "test_predictions_in_lab"),
    ("callbacks were picked to the end", GAME, "state.text", "test_order_game_in_lab", "you broke it"),
    ("a check is done", SUCCESS, " points.", "test_success_in_lab"),
    ("a check has full points", SUCCESS, " Full points.", "test_success_in_lab"),
    ("a lesson is done", SUCCESS, " done", "test_success_in_lab"),
    ("an assignment is passed", SUCCESS, " passed, ", "test_success_in_lab"),
    ("the kernel was restarted", PANEL, RESTARTED, "test_robot_sidebar"),
    ("Validate runs a check", VALIDATE, "Check ${++number} of ", "test_validate", "Check 2 of 2: "),
    ("Validate runs a cell", VALIDATE, "Cell [${count}]: ", "test_validate", "Cell [1]: "),
)]  # fmt: skip


def test_every_region_is_in_the_list():
    scripts = {
        path.relative_to(ROOT).as_posix()
        for folder in (WEB, LAB, "sim/standalone")
        for path in (ROOT / folder).iterdir()
        if path.is_file() and path.suffix in (".js", ".html") and REGION.search(path.read_text())
    }
    assert scripts == {each.script for each in ANNOUNCEMENTS}


@pytest.mark.parametrize("each", ANNOUNCEMENTS, ids=lambda each: each.when.replace(" ", "-"))
def test_an_announcement_has_its_words_and_a_test(each):
    sources = [path.read_text() for path in (ROOT / WEB).glob("*.js")] + [(ROOT / each.script).read_text()]
    assert any(each.words in source for source in sources)
    test = (ROOT / "tests" / "browser" / f"{each.test}.py").read_text()
    assert (each.sought or each.words).strip() in test
