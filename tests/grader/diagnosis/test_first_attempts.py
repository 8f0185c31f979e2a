"""Mistakes of a first node, by real nodes, and the sentence of `tell` for each."""

import pytest
from rclpy.node import Node
from std_msgs.msg import String

from grader.diagnosis import find_flaw
from sim import run


class Talker(Node):
    period = 0.5
    wanted = 0

    def __init__(self):
        super().__init__("talker")
        self.count = 0
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(self.period, self.tick)

    def tick(self):
        self.count += 1
        if self.count > self.wanted:
            self.publisher.publish(String(data="Hello"))


class EveryFiveSeconds(Talker):
    period = 5.0


class WaitsForTheHundredth(Talker):
    wanted = 100


class Echo(Node):
    def __init__(self):
        super().__init__("echo")
        self.publisher = self.create_publisher(String, "/echo", 10)
        self.create_subscription(String, "/chatter", self.receive, 10)

    def receive(self, message):
        if message.data == "hello":
            self.publisher.publish(message)


class TwoTopics(Talker):
    """It publishes an alarm only when there is one."""

    def __init__(self):
        super().__init__()
        self.alarm = self.create_publisher(String, "/alarm", 10)


def test_a_publish_that_is_never_reached():
    assert find_flaw(run(WaitsForTheHundredth, seconds=3, quiet=True)) == (
        "/talker has a publisher on /chatter, but never publishes: WaitsForTheHundredth.tick ran 6 times, and "
        "publish() was never reached. Look for an `if` that is never true, a `return` before it, or a method that "
        "is never called; a print in front of it shows which."
    )


def test_a_publish_in_a_subscription_that_is_never_reached():
    sentence = find_flaw(run(Talker, Echo, seconds=1.2, quiet=True))
    assert sentence.startswith(
        "/echo has a publisher on /echo, but never publishes: Echo.receive ran 2 times, and"
    )


@pytest.mark.parametrize("seconds, count", [(6, "once"), (12, "2 times")])
def test_a_period_of_5_in_place_of_half_a_second(seconds, count):
    assert find_flaw(run(EveryFiveSeconds, seconds=seconds, quiet=True)) == (
        f"The timer of /talker has a period of 5 s: EveryFiveSeconds.tick ran {count} in {seconds} s. The period is "
        "1 / rate, in seconds: 0.5 s gives 2 Hz."
    )


def test_a_period_that_is_longer_than_the_run():
    assert find_flaw(run(EveryFiveSeconds, seconds=3, quiet=True)) == (
        "The timer of /talker has a period of 5 s: EveryFiveSeconds.tick would run at 5 s, and never ran in 3 s. The "
        "period is 1 / rate, in seconds: 0.5 s gives 2 Hz."
    )


@pytest.mark.parametrize("node, seconds", [(Talker, 3), (EveryFiveSeconds, 20)])
def test_a_right_node_is_not_blamed(node, seconds):
    assert find_flaw(run(node, seconds=seconds, quiet=True)) == ""


def test_a_node_that_publishes_elsewhere_reaches_publish():
    assert "never reached" not in find_flaw(run(TwoTopics, seconds=3, quiet=True))
