"""A site with a bad radio link between a panel and a dispenser: it places orders, and carries messages."""

import random
from collections.abc import Callable
from functools import partial

from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import Int32, String

WITH_JUDGE = True  # it knows what the link carries
FIRST, APART, ORDERS = 1.0, 2.6, 5  # s, s, and their number
NEITHER, NO_ANSWERS = "neither", "no answers"  # what the link carries for an order, where it isn't both
MOST_SCREWS = 3  # fewer than the orders that are carried out, so that two of them are equal
LOSS, MOST_IN_A_ROW = 0.4, 2  # the share of messages that are lost, and how many one after the other
TWICE = 0.3  # the share of messages that arrive twice
DELAY = 0.03, 0.18  # s
LATE_ANSWER, LATE_REQUEST = 0.01, 0.6  # s after the next order


class RadioSite(Node):
    """Places orders (Int32 on /orders), and is the radio link between the panel and the dispenser.

    The link carries strings from /panel/sent to /dispenser/received and from /dispenser/sent to
    /panel/received. It loses some, carries some twice and delays all of them. One order's messages are all
    lost, and for another one the dispenser's are. The seed decides everything.
    """

    def __init__(self, seed: int = 0) -> None:
        super().__init__("radio_site")
        self.orders = self.create_publisher(Int32, "/orders", 10)
        self.to_dispenser = self.create_publisher(String, "/dispenser/received", 10)
        self.to_panel = self.create_publisher(String, "/panel/received", 10)
        self.create_subscription(String, "/panel/sent", self.on_request, 10)
        self.create_subscription(String, "/dispenser/sent", self.on_answer, 10)
        self.conditions = draw_conditions(seed)
        self.screws = [random.randint(1, MOST_SCREWS) for _ in range(ORDERS)]
        self.number = -1
        self.lost = {self.to_dispenser: MOST_IN_A_ROW, self.to_panel: 0}  # the first request is carried
        self.last: dict[Publisher, String] = {}
        for number in range(ORDERS):
            self.after(FIRST + APART * number, self.place_order)

    def place_order(self) -> None:
        """Publish the next order. Later, late copies of the messages of the one before arrive."""
        self.number += 1
        self.orders.publish(Int32(data=self.screws[self.number]))
        for publisher, late in ((self.to_panel, LATE_ANSWER), (self.to_dispenser, LATE_REQUEST)):
            if publisher in self.last:
                self.carry(publisher, self.last.pop(publisher), late)

    def on_request(self, message: String) -> None:
        """Carry a message of the panel, unless it is lost."""
        if self.condition != NEITHER:
            self.carry_badly(self.to_dispenser, message)

    def on_answer(self, message: String) -> None:
        """Carry a message of the dispenser, unless it is lost."""
        if not self.condition:
            self.carry_badly(self.to_panel, message)

    @property
    def condition(self) -> str:
        """The part that the link doesn't carry at this time: "" if it carries both."""
        return self.conditions[self.number] if self.number >= 0 else ""

    def carry_badly(self, publisher: Publisher, message: String) -> None:
        """Lose a message, or carry it once or twice."""
        self.last[publisher] = message
        if self.lost[publisher] < MOST_IN_A_ROW and random.random() < LOSS:
            self.lost[publisher] += 1
            return
        self.lost[publisher] = 0
        for _ in range(1 + (random.random() < TWICE)):
            self.carry(publisher, message, random.uniform(*DELAY))

    def carry(self, publisher: Publisher, message: String, seconds: float) -> None:
        """Let a message arrive after so many seconds."""
        self.after(seconds, lambda: publisher.publish(message))

    def after(self, seconds: float, action: Callable[[], None]) -> None:
        """Do something once, after so many seconds."""

        def once() -> None:
            timer.cancel()
            self.destroy_timer(timer)
            action()

        timer = self.create_timer(seconds, once)



def draw_conditions(seed: int) -> list[str]:
    """Return what the link doesn't carry for each order of a run with this seed; "" if it carries both."""
    conditions = [NEITHER, NO_ANSWERS, *[""] * (ORDERS - 3)]
    random.Random(f"radio link {seed}").shuffle(conditions)
    return ["", *conditions]


def radio_site(seed: int) -> list[Callable[[], RadioSite]]:
    """Return the site of this seed, as companions of a run."""
    return [partial(RadioSite, seed)]
