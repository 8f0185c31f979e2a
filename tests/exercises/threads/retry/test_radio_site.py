"""The radio link: what it loses, carries twice and carries late, and in no message what its condition is."""

import pytest
from rclpy.node import Node
from std_msgs.msg import String

from grader.exercises.threads.retry.radio_site import (
    APART,
    FIRST,
    MOST_IN_A_ROW,
    MOST_SCREWS,
    NEITHER,
    NO_ANSWERS,
    ORDERS,
    draw_conditions,
    radio_site,
)
from sim import run

SECONDS = FIRST + APART * ORDERS


class Ends(Node):
    """Both ends of the link: numbered messages ten times a second, each with an answer."""

    def __init__(self):
        super().__init__("ends")
        self.sent = 0
        self.panel = self.create_publisher(String, "/panel/sent", 10)
        self.dispenser = self.create_publisher(String, "/dispenser/sent", 10)
        self.create_subscription(String, "/dispenser/received", self.dispenser.publish, 10)
        self.create_timer(0.1, self.send)

    def send(self):
        self.sent += 1
        self.panel.publish(String(data=str(self.sent)))


@pytest.fixture(scope="module")
def recording():
    return run(Ends, companions=radio_site(3), seconds=SECONDS, seed=3, quiet=True)


def numbers(recording, topic):
    return [int(row.message.data) for row in recording.messages(topic)]


@pytest.mark.parametrize("seed", range(50))
def test_each_run_has_one_order_of_each_kind_and_begins_with_one_that_is_carried(seed):
    conditions = draw_conditions(seed)
    assert sorted(conditions) == sorted([NEITHER, NO_ANSWERS, *[""] * (ORDERS - 2)])
    assert conditions[0] == ""


def test_it_places_all_orders_and_two_that_are_carried_out_are_equal(recording):
    rows = recording.messages("/orders")
    assert [row.stamp for row in rows] == pytest.approx([FIRST + APART * each for each in range(ORDERS)])
    carried = [
        row.message.data for row, lost in zip(rows, draw_conditions(3), strict=True) if lost != NEITHER
    ]
    assert len(set(carried)) < len(carried)
    assert max(carried) <= MOST_SCREWS


def test_it_loses_at_most_two_in_a_row_while_it_works_and_carries_some_twice(recording):
    arrived = numbers(recording.during(FIRST, FIRST + APART), "/dispenser/received")
    assert len(set(arrived)) < len(arrived)
    missing = sorted(set(range(min(arrived), max(arrived))) - set(arrived))
    assert missing
    runs = [all(first + step in missing for step in range(MOST_IN_A_ROW + 1)) for first in missing]
    assert not any(runs)


def test_nothing_arrives_in_a_direction_that_is_down_but_a_late_copy(recording):
    conditions = draw_conditions(3)
    for lost, topic in ((NEITHER, "/dispenser/received"), (NO_ANSWERS, "/panel/received")):
        begin = FIRST + APART * conditions.index(lost)
        down = recording.during(begin + 0.3, begin + APART)
        assert len(down.messages(topic)) == (topic == "/dispenser/received")


def test_the_last_answer_to_the_order_before_arrives_right_after_the_next_order(recording):
    conditions = draw_conditions(3)
    for number in range(1, ORDERS):
        if not conditions[number - 1]:
            begin = FIRST + APART * number
            assert recording.during(begin + 0.005, begin + 0.02).messages("/panel/received")
