"""Tests of an order's text, and of what varies at each level."""

import re

import pytest
from rclpy.node import Node
from std_msgs.msg import Int32

from sim import explore, run
from sim.order import LEVELS, Order
from tests.sim.ros.racy_programs import CountsFromOne, PairsByArrival, Sensor, TwoTimers


def no_errors(recording):
    return not recording.errors


class PairsBackwards(PairsByArrival):
    """Its subscription to /b is the first, and it takes it that /b is always taken first."""

    def __init__(self):
        Node.__init__(self, "backwards")
        self.create_subscription(Int32, "b", self.on_b, 10)
        self.create_subscription(Int32, "a", self.on_a, 10)
        self.first = None

    def on_b(self, message):
        self.first = message.data

    def on_a(self, message):
        assert self.first == message.data


@pytest.mark.parametrize("text", ["17", "k3f9", "host-5", "any-k3f9@20ms", "3+0s", "1:2b71ed", "1@2ms+0s:"])
def test_an_order_is_its_text(text):
    assert str(Order.parse(text)) == text
    assert Order.parse(str(Order.parse(text))) == Order.parse(text)


@pytest.mark.parametrize("usual", [0, "0", "", None])
def test_the_usual_order_is_none(usual):
    assert Order.parse(usual) is None


@pytest.mark.parametrize(
    ("order", "error", "words"),
    [
        (-1, ValueError, "order must be 0 or more, or the string of an order such as 'k3f9'; it is -1."),
        (
            "k 3",
            ValueError,
            "order must be 0 or more, or the string of an order such as 'k3f9'; it is 'k 3'.",
        ),
        (1.5, TypeError, "order must be a whole number, or a string such as 'k3f9'; it is 1.5."),
        (True, TypeError, "order must be a whole number, or a string such as 'k3f9'; it is True."),
    ],
)
def test_what_is_no_order_is_refused(order, error, words):
    with pytest.raises(error, match=re.escape(words)):
        run(Sensor, order=order)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"level": "planet"}, "level must be 'host', 'network' or 'any'; it is 'planet'."),
        ({"orders": 0}, "orders must be a whole number, 1 or more; it is 0."),
        ({"spread": 2}, "spread must be seconds, more than 0 and at most 1; it is 2."),
    ],
)
def test_what_explore_can_not_do_is_refused(arguments, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        explore(Sensor, holds=lambda recording: True, **arguments)


def test_draws_of_one_name_do_not_depend_on_others():
    order = Order("17")
    assert order.draw("a", 1) == Order("17").draw("a", 1)
    assert order.draw("a", 1) != order.draw("a", 2)
    assert order.draw("a", 1) != Order("18").draw("a", 1)


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize(
    ("programs", "varies_at"),
    [
        pytest.param((PairsByArrival, Sensor), ("network", "any"), id="topics of one sender"),
        pytest.param((PairsBackwards, Sensor), LEVELS, id="subscriptions in the other order"),
        pytest.param((CountsFromOne, Sensor), LEVELS, id="starts"),
        pytest.param((TwoTimers,), ("any",), id="timers of one node"),
    ],
)
def test_a_level_varies_what_varies_there(level, programs, varies_at):
    found = explore(*programs, holds=no_errors, level=level, orders=40, seconds=2)
    assert bool(found.failed) == (level in varies_at), found.explanation


def test_one_publishers_messages_keep_their_order():
    for order in range(1, 30):
        recording = run(Sensor, Listens, seconds=2, quiet=True, order=f"any-{order}@50ms")
        assert recording.errors == []


class Listens(Node):
    """Its numbers only ever rise."""

    def __init__(self):
        super().__init__("listens")
        self.newest = 0
        self.create_subscription(Int32, "a", self.on_a, 10)

    def on_a(self, message):
        assert message.data > self.newest
        self.newest = message.data


def test_what_was_found_is_explained():
    found = explore(PairsByArrival, Sensor, holds=no_errors, seconds=2)
    line = "`assert self.last.data == message.data`"
    pattern = (
        r"In order \d+, .+ at [\d.]+ s\. `PairsByArrival\.on_b` reads PairsByArrival\.last = .+ \(line \d+\) "
        r"before `PairsByArrival\.on_a` writes PairsByArrival\.last = .+ \(line \d+\); in the usual order "
        r"it reads .+ there\. Then `PairsByArrival\.on_b` fails at [\d.]+ s, at line \d+: "
        + re.escape(line)
        + r": .+\. It fails again in 10 of 10 runs\. Run it again with run\(\.\.\., order='.+'\)\."
    )
    assert re.fullmatch(pattern, found.explanation)
    assert repr(found) == found.explanation
    html = found._repr_html_()
    assert "The usual order" in html and "This order" in html
    assert found.departures[0].text in html


def test_what_holds_in_all_orders_says_so():
    found = explore(Sensor, holds=lambda recording: True, orders=3, seconds=1)
    assert found.explanation == "It holds in the usual order and in 3 others."
    assert found.departures == []


def test_what_does_not_hold_in_the_usual_order_is_not_due_to_an_order():
    found = explore(Sensor, holds=lambda recording: False, seconds=1)
    assert found.explanation == "It does not hold in the usual order."
    assert found.tried == 0


def test_an_interrupt_keeps_what_was_found():
    tried = []

    def holds(recording):
        tried.append(recording.order)
        if len(tried) == 4:
            raise KeyboardInterrupt
        return True

    found = explore(Sensor, holds=holds, seconds=1)
    assert found.explanation == "It holds in the usual order and in 2 others. The search was interrupted."
    assert found.interrupted


def test_the_level_any_says_that_rclpy_always_has_the_usual_order():
    found = explore(TwoTimers, holds=no_errors, level="any", seconds=2)
    assert (
        "Nothing guarantees the usual order, although the current rclpy always uses it." in found.explanation
    )


def test_the_students_code_is_as_before_afterwards():
    code = PairsByArrival.on_b.__code__
    run(PairsByArrival, Sensor, seconds=1, quiet=True, order=1)
    assert PairsByArrival.on_b.__code__ is code
