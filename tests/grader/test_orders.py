"""Tests that an exercise's runs happen in different orders, and that a miss says where they part."""

import pytest
from rclpy.node import Node
from std_msgs.msg import Int32

from grader import Exercise
from grader.checks import Missed
from grader.orders import order_of_run, without_late_start
from grader.programs import LocalPrograms
from grader.scenario import Scenario
from sim import explore

SEEDS = (1, 2, 3, 4)


class Source(Node):
    """Publishes one number on /a and on /b, ten times a second."""

    def __init__(self):
        super().__init__("source")
        self.number, self.publishers_ = 0, [self.create_publisher(Int32, topic, 10) for topic in ("a", "b")]
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.number += 1
        for publisher in self.publishers_:
            publisher.publish(Int32(data=self.number))


class PairsByArrival(Node):
    """Adds the newest /a to each /b."""

    def __init__(self):
        super().__init__("adder")
        self.last = Int32()
        self.publisher = self.create_publisher(Int32, "sum", 10)
        self.create_subscription(Int32, "a", self.on_a, 10)
        self.create_subscription(Int32, "b", self.on_b, 10)

    def on_a(self, message):
        self.last = message

    def on_b(self, message):
        self.publisher.publish(Int32(data=self.last.data + message.data))


class PairsByNumber(PairsByArrival):
    """Waits until it has both."""

    def __init__(self):
        super().__init__()
        self.known = set()

    def on_a(self, message):
        if message.data in self.known:
            self.publisher.publish(Int32(data=2 * message.data))
        self.known ^= {message.data}

    on_b = on_a


@pytest.fixture
def adds():
    exercise = Exercise("adds", "A sum", seconds=3, companions=[Source], seeds=SEEDS)

    @exercise.check(4)
    def sends(run):
        """Each sum is even."""
        odd = [row.message.data for row in run.messages("/sum") if row.message.data % 2]
        if odd or not run.messages("/sum"):
            raise Missed("even sums on /sum", f"{odd[0] if odd else 'nothing'}")

    return exercise


def test_each_run_has_an_order_of_its_own_but_the_first_one_in_public():
    orders = [order_of_run(index, seed, public=True) for index, seed in enumerate(SEEDS)]
    private = [order_of_run(index, seed, public=False) for index, seed in enumerate(SEEDS)]
    assert orders == ["", *private[1:]]
    assert len(set(private)) == len(SEEDS)
    assert {len(order) for order in private} == {4}


def test_a_run_whose_world_does_not_wait_has_no_late_start():
    assert without_late_start("k3f9") == "k3f9+0s"
    assert without_late_start("") == ""


def test_a_scenario_that_is_fair_in_the_usual_order_alone_has_that_one():
    runs = [
        Scenario(seconds=0.5, any_order=any_order).run(LocalPrograms([Source]), 1, order="k3f9")
        for any_order in (True, False)
    ]
    assert [run.order for run in runs] == ["k3f9", ""]


def test_a_node_that_is_right_in_every_order_earns_everything(adds):
    score = adds.grade(PairsByNumber)
    assert float(score) == 4
    assert score.differences == ()


def test_the_feedback_of_a_node_that_is_right_by_luck_says_where_the_orders_part(adds):
    score = adds.grade(PairsByArrival)
    assert float(score) == 0
    (verdict,) = score.verdicts
    (difference, *_) = score.differences
    assert verdict.saw.startswith("in another order of the events at ")
    assert 1 <= len(difference.other.departures) <= 3
    assert repr(difference).startswith("On a robot this order is possible, too: ")
    assert f"order={difference.other.order!r}" in repr(difference)
    assert "The usual order" in difference._repr_html_()
    recording, holds = adds.in_order(PairsByArrival, order=difference.other.order)
    assert not holds
    assert recording.departures


@pytest.fixture
def adds_and_counts(adds):
    @adds.check(1)
    def counts(run):
        """The node publishes on /count."""
        if not run.messages("/count"):
            raise Missed("messages on /count", "none")

    return adds


def test_a_first_miss_does_not_buy_the_usual_order_for_the_other_runs(adds_and_counts):
    score = adds_and_counts.grade(PairsByArrival)
    assert [verdict.status for verdict in score.verdicts] == ["failed", "failed"]
    sums, count = score.verdicts
    assert (sums.run, count.run) == (1, 0)
    assert sums.saw.startswith("in another order of the events at ")
    assert count.saw == "none"


def test_a_program_with_one_run_is_judged_in_another_order_when_it_is_marked(adds):
    adds.seeds = SEEDS[:1]
    assert float(adds.grade(PairsByArrival)) == 4
    assert float(adds.judge(LocalPrograms([PairsByArrival]), "a secret")) == 0


def test_credit_in_the_usual_order_is_not_earned_in_another_one():
    exercise = Exercise("adds_partly", "A sum", seconds=3, companions=[Source], seeds=SEEDS)

    @exercise.check(4)
    def sends(run):
        """The sums are even, and there are five hundred of them."""
        odd = any(row.message.data % 2 for row in run.messages("/sum"))
        raise Missed("five hundred even sums", "fewer", credit=0.0 if odd else 0.5)

    assert float(exercise.grade(PairsByNumber)) == 2
    assert float(exercise.grade(PairsByArrival)) == 0


def test_a_private_order_is_not_shown(adds):
    score = adds.judge(LocalPrograms([PairsByArrival]), "a secret")
    assert "order=" not in repr(score.differences[0])


def test_explore_takes_an_exercise(adds):
    found = explore(PairsByArrival, holds=adds)
    assert found.failed
    assert len(found.departures) <= 3
    assert explore(PairsByNumber, holds=adds, orders=5).failed is None
