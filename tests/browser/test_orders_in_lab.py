"""An explored order in JupyterLab: the sentence, both runs side by side, their replays."""

import pytest

from tests.browser.lab import write_notebook

pytestmark = pytest.mark.browser
SETUP = """
from rclpy.node import Node
from std_msgs.msg import Int32
from sim import explore, run
"""
NODES = """
class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.number, self.both = 0, [self.create_publisher(Int32, name, 10) for name in ("a", "b")]
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.number += 1
        for publisher in self.both:
            publisher.publish(Int32(data=self.number))


class Pairs(Node):
    def __init__(self):
        super().__init__("pairs")
        self.last = None
        self.create_subscription(Int32, "a", self.on_a, 10)
        self.create_subscription(Int32, "b", self.on_b, 10)

    def on_a(self, message):
        self.last = message

    def on_b(self, message):
        assert self.last.data == message.data
"""
EXPLORE = """
found = explore(Pairs, Sensor, holds=lambda run: not run.errors, seconds=2, world="room")
found
"""
AGAIN = """
run(Pairs, Sensor, seconds=2, world="room", quiet=True, expect_error=True,
    order=found.failed).digest == found.recording.digest
"""


def test_an_order_that_fails_is_explained(students_folder, open_lab):
    write_notebook(students_folder / "orders/pairs.ipynb", SETUP, NODES, EXPLORE, AGAIN)
    with open_lab("orders/pairs.ipynb") as lab:
        lab.run_all()
        html = lab.outputs(2)[-1]["data"]["text/html"]
        assert "Then `Pairs.on_b` fails" in html
        assert html.count("ros2-replay") >= 2
        assert lab.outputs(3)[-1]["data"]["text/plain"] == "True"
        tables = lab.cell(2).locator(".sim-orders table")
        assert tables.count() == 2
        assert tables.nth(1).locator(".departure").count() >= 1
        tables.first.scroll_into_view_if_needed()
        lab.screenshot("order")
        with lab.narrow_and_dark():
            tables.first.scroll_into_view_if_needed()
            lab.screenshot("order-narrow-dark")
