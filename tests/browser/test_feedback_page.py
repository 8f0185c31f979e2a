"""The pages that are made of a submission: the course's replays play, and no student's code runs."""

import contextlib
import re

import nbformat
import pytest

from grader.__main__ import main
from grader.marking.release.demo import mark_samples
from sim.view.interactive import plot_script
from sim.view.replay import PLAYER_SCRIPT
from tests.browser.lab import ROOT, server
from tests.browser.pictures import Picture, patient_page, point_at, watch
from tests.marking.hostile import corpus
from tests.marking.tiny import answer, course, grade

pytestmark = pytest.mark.browser
HOSTILE = (ROOT / "tests" / "students" / "hostile_page.py").read_text()
STEAL = "window.stolen=(window.stolen||0)+1"
NODE = """
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from geometry_msgs.msg import Twist
from rclpy.qos import qos_profile_system_default as qos

class TooShort(Node):
    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "cmd_vel", qos)
        self.create_timer(0.1, self.tick)
        self.end = self.get_clock().now() + Duration(seconds=2)

    def tick(self):
        twist = Twist()
        twist.linear.x = 0.3 if self.get_clock().now() < self.end else 0.0
        self.publisher.publish(twist)
"""
TEST = """
from grader import Exercise, Missed, check
from grader.checks import arrives

@check(points=1)
def comes(recording):
    "The robot comes to its goal."
    arrives(recording, (1.5, 1.0))

@check(points=1)
def stands(recording):
    "It stands still."
    raise Missed("0 m/s", "it moved at 1.75 s", picture="topics")

Exercise("drive", "Drive", checks=[comes, stands], world="room", seconds=4).grade(TooShort)
"""


@pytest.fixture(scope="module")
def submission(tmp_path_factory):
    """A course with a submission that misses a check, shows a hostile page and has hostile Markdown."""
    folder = course(
        tmp_path_factory.mktemp("class"),
        answer("node", f"### BEGIN SOLUTION\n{NODE}\n### END SOLUTION"),
        grade("test_drive", 2, TEST),
        answer("page", f"### BEGIN SOLUTION\n{HOSTILE}\n### END SOLUTION"),
        grade("test_page", 1, "1.0"),
        nbformat.v4.new_markdown_cell(f"<script>{STEAL}</script> <img src=x onerror='{STEAL}'>", id="words"),
    )
    with pytest.MonkeyPatch.context() as patch:  # of the samples, the right one alone
        for module in ("samples", "demo"):
            patch.setattr(f"grader.marking.release.{module}.SHARES", {"right": 1.0})
        (marked,) = mark_samples(folder, "01_tiny")
    return folder, marked


def check_page(page, address: str, name: str) -> None:
    """Open the page: the replay plays in it, nothing else has run, nothing came from elsewhere."""
    requests = watch(page)
    page.goto(address)
    replay = Picture(page.locator(".ros2-view:has(canvas)").first)
    replay.plays()
    replay.screenshot(name)
    assert page.evaluate("window.stolen") is None
    assert [url for url in requests if "collector" in url] == []
    shown = page.locator("#notebook-container")
    assert shown.locator("[onclick], [onerror], [onload], iframe:not(.isolated-iframe)").count() == 0
    assert PLAYER_SCRIPT in shown.locator("script").all_text_contents()
    assert set(shown.locator("script").all_text_contents()) <= {PLAYER_SCRIPT, plot_script()}
    assert shown.locator(".navbar-fixed-top, .modal-backdrop").count() == 0
    assert shown.get_by_text("forged").count() >= 2  # what can't be played shows what was there before


def check_time_link(page) -> None:
    """The replay opens a second before the moment that a check names; the link moves it there."""
    replay = Picture(page.locator(".ros2-view:has(canvas)").first)
    replay.root.wait_for()
    assert replay.time() == 0.75
    mark = replay.root.locator(".marks .missed")
    assert mark.get_attribute("aria-label") == "t = 1.75 s: It stands still. it moved at 1.75 s"
    page.get_by_role("link", name="1.75 s").click()
    assert (replay.time(), replay.value("v")) == (1.75, "0.30 m/s")
    point_at(page.locator(".ros2-time-plot"), 0.5)
    assert replay.time() == pytest.approx(2.0, abs=0.02)


def test_a_feedback_page_plays_the_replay_and_nothing_of_the_submission(browser, submission):
    _, marked = submission
    assert marked.points["test_drive"] == (0, 2)
    page = patient_page(browser, viewport={"width": 1100, "height": 900})
    check_page(page, marked.feedback.as_uri(), "feedback")
    page.reload()
    check_time_link(page)
    page.close()


def test_the_formgrader_plays_the_replay_and_nothing_of_the_submission(browser, submission):
    folder, _ = submission
    with server(folder, "--allow-root") as address:
        page = patient_page(browser, viewport={"width": 1100, "height": 900})
        notebooks = f"{address}/formgrader/api/submitted_notebooks/01_tiny/tiny"
        right = next(one for one in page.request.get(notebooks).json() if one["student"] == "right")
        check_page(page, f"{address}/formgrader/submissions/{right['id']}/", "formgrader")
        page.close()


@pytest.fixture(scope="module")
def marked_class(tmp_path_factory):
    """A class marked by `python -m grader mark`: anna drives in circles, and shows a hostile page."""
    folder = corpus.course(tmp_path_factory.mktemp("marked"))
    starter = nbformat.read(folder / "exercises" / corpus.ASSIGNMENT / corpus.NAME, 4)
    driver = re.sub("twist.linear.x = .*", "twist.linear.x, twist.angular.z = 0.3, 0.3", NODE)
    driver = driver.replace("TooShort", "SquareDriver")
    notebook = corpus.with_trick(starter, f"# %% square\n{driver}\n# %% after square-points\n{HOSTILE}")
    notebook.cells.append(nbformat.v4.new_markdown_cell(f"<script>{STEAL}</script>", id="words"))
    place = folder / "class" / "submitted" / "anna" / corpus.ASSIGNMENT
    place.mkdir(parents=True)
    nbformat.write(notebook, place / corpus.NAME)
    with contextlib.chdir(folder):
        assert main(["mark", corpus.ASSIGNMENT, "--jobs", "1"]) == 0
    return folder


def test_a_page_of_the_class_marker_plays_the_replay_and_tells_no_secret(browser, marked_class):
    path = marked_class / "class" / "feedback" / "anna" / corpus.ASSIGNMENT / "topics.html"
    page = patient_page(browser, viewport={"width": 1100, "height": 900})
    check_page(page, path.as_uri(), "feedback-of-mark")
    assert page.get_by_text("Expected:").count() > 0
    page.close()
    text = path.read_text()
    assert [word for word in (corpus.SECRET, str(marked_class), "site-packages") if word in text] == []


def test_the_formgrader_plays_the_replay_of_the_class_marker(browser, marked_class):
    with server(marked_class, "--allow-root") as address:
        page = patient_page(browser, viewport={"width": 1100, "height": 900})
        notebooks = f"{address}/formgrader/api/submitted_notebooks/{corpus.ASSIGNMENT}/topics"
        (anna,) = page.request.get(notebooks).json()
        assert (anna["student"], anna["max_score"]) == ("anna", 33)
        check_page(page, f"{address}/formgrader/submissions/{anna['id']}/", "formgrader-of-mark")
        page.close()
