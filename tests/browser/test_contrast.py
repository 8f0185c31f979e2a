"""Texts of the course's own pictures, cards and tables can be read, in light and dark: WCAG 2, level AA."""

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.exercises import nodes
from sim import run
from sim.notebook import failure_html
from sim.view import plot_logs, plot_path, plot_signal
from sim.view.prediction import SCRIPT, Prediction
from tests.browser.contrast import poor_texts

pytestmark = pytest.mark.browser
# Text, ground and links of JupyterLab's pages.
THEMES = {"light": ("#111", "#fff", "#1976d2"), "dark": ("#e0e0e0", "#111", "#64b5f6")}


class Talker(Node):
    """Logs at each level, drives into the wall, and fails."""

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.count = 0

    def drive(self):
        command = Twist()
        command.linear.x = 0.6
        self.publisher.publish(command)
        self.count += 1
        if self.count == 40:
            self.get_logger().info("I drive")
            self.get_logger().warning("I drive")
            self.get_logger().error("I drive")
            self.get_logger().fatal("I drive")
        if self.count == 90:
            raise RuntimeError("stuck")


class Counter(Node):
    """Counts half as fast as the exercise asks for."""

    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.count += 1
        self.get_logger().info(f"Count: {self.count}")


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """Whatever the course shows in a notebook, as HTML."""
    recording = run(Talker, world="room", seconds=20, quiet=True)
    guess = Prediction("Does it fall?", {"a": "yes", "b": "no"}, tmp_path_factory.mktemp("work") / "p.json")
    other = Prediction("Does it rise?", guess.answers, guess._file)
    cards = [
        f'<div class="ros2-prediction"{each._data()}><p><b>Predict:</b> {each.question}</p>'
        '<ul><li data-letter="a"><b>a</b> yes</li><li data-letter="b"><b>b</b> no</li></ul></div>'
        for each in (guess, other)
    ]
    outcomes = [guess._outcome_html(letter, "At once.") for letter in "ab"]
    outcomes = [each.replace('data-predicted=""', 'data-predicted="a"') for each in outcomes]
    recorded = other._outcome_html("a", "").replace("ros2-outcome", 'ros2-outcome" data-recorded="')
    return [
        recording.replay().html,
        plot_path(recording).html,
        plot_signal(recording, "/odom", "pose.pose.position.x", "twist.twist.linear.x").html,
        plot_logs(recording)._repr_mimebundle_().get("text/html", ""),
        failure_html(recording.failure.splitlines()),
        nodes.counter.grade(Counter)._repr_html_(),
        *cards,
        *outcomes,
        recorded,
        f"<script>{SCRIPT}</script>",
    ]


@pytest.mark.parametrize("theme", THEMES)
def test_texts_of_outputs_can_be_read(page, parts, theme):
    ink, ground, link = THEMES[theme]
    body = f"body {{ font: 14px sans-serif; color: {ink}; background: {ground} }}"
    style = f"<style>{body} :where(a) {{ color: {link} }}</style>"
    page.set_viewport_size({"width": 1000, "height": 900})
    page.emulate_media(color_scheme=theme)
    page.set_content(f"<!doctype html>{style}{''.join(parts)}")
    page.locator(".ros2-prediction button").first.wait_for()
    page.locator(".ros2-time-plot").first.wait_for()
    page.locator(".ros2-outcome button").wait_for()
    assert poor_texts(page) == []


def test_a_pale_text_is_found(page):
    for style in ("color: #888", "opacity: .5", "color: #000; background: rgba(0, 0, 0, .6)"):
        page.set_content(f'<p class="pale" style="{style}">Words</p><p style="color: #666">More</p>')
        (line,) = poor_texts(page)
        assert line.endswith("| pale | Words")
