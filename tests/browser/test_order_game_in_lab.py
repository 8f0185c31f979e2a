"""A student is the executor: picks with the keyboard which callback continues, until the robot drives on."""

import pytest

from tests.browser.lab import write_notebook

pytestmark = pytest.mark.browser
NAME = "orders/by_hand.ipynb"
SETUP = """
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sim import schedule
"""
NODE = """
class Courier(Node):
    def __init__(self):
        super().__init__("courier")
        self.driving = True
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)

    def drive(self):
        if self.driving:
            self.send(0.3)

    def on_near(self):
        self.driving = False
        self.send(0.0)

    def send(self, speed):
        command = Twist()
        command.linear.x = speed
        self.publisher.publish(command)


def last(run):
    commands = run.messages("/cmd_vel")
    return f"The robot's last command: {commands[-1].message.linear.x if commands else 'none'}"
"""
GAME = """
game = schedule(
    Courier, "drive", "on_near", holds=lambda run: last(run).endswith(": 0.0"), threads=True, watch=last)
"""
BROKEN = "All callbacks are done. It doesn't hold: you broke it."
HOLDS = "All callbacks are done. It still holds. Try another order."


def test_the_game_is_played_by_keyboard(students_folder, open_lab):
    write_notebook(students_folder / NAME, SETUP, NODE, GAME)
    with open_lab(NAME) as lab:
        lab.run_all()
        game = lab.cell(2).locator(".ros2-game")
        status = game.locator("[role=status]")
        game.wait_for()
        assert game.locator(".call button").all_inner_texts() == ["1 drive(): is due", "2 on_near(): is due"]
        game.focus()
        for key, text in (("1", "Pick 1 or 2."), ("1", "Pick 2."), ("2", "Pick 2."), ("2", HOLDS)):
            before = game.locator("ol li").count()
            lab.page.keyboard.press(key)
            game.locator("ol li").nth(before).wait_for()
            assert status.inner_text() == text
        assert "holds" in game.get_attribute("class")
        lab.page.keyboard.press("r")
        status.get_by_text("Pick 1 or 2.").wait_for()
        for key in "12":
            before = game.locator("ol li").count()
            lab.page.keyboard.press(key)
            game.locator("ol li").nth(before).wait_for()
        lab.screenshot("order-game")
        assert game.locator(".next").all_inner_texts() == ["        self.send(0.3)", "    self.send(0.0)"]
        assert "self.driving = False" in game.inner_text()
        lab.page.keyboard.press("Backspace")
        game.locator("button", has_text="on_near(): is due").wait_for()
        for key in "221":
            before = game.locator("ol li").count()
            lab.page.keyboard.press(key)
            game.locator("ol li").nth(before).wait_for()
        assert status.inner_text() == BROKEN
        assert "The robot's last command: 0.3" in game.inner_text()
        assert "Orders played to the end: 2" in game.inner_text()
        assert game.locator(".call button:enabled").count() == 0
        lab.screenshot("order-game-broken")
        with lab.narrow_and_dark():
            game.scroll_into_view_if_needed()
            lab.screenshot("order-game-narrow-dark")
            assert lab.cell(2).evaluate("cell => cell.scrollWidth <= cell.clientWidth")
        assert lab.ask("game.picks") == [1, 2, 2, 1]
        game.locator("button", has_text="Undo").click()
        status.get_by_text("Pick 1.").wait_for()
        game.locator(".call button", has_text="drive()").click()
        status.get_by_text(BROKEN).wait_for()
