"""A publisher in one line."""

from grader.checks import publishes, rate
from grader.exercise import Exercise
from grader.variants import Variants
from sim.evidence import Recording

greeting = Exercise("greeting", "A publisher in one line", seconds=5, variants=Variants(
    {"topic": ("/greeting", "/welcome", "/hello")},
    {"period": (0.5, 0.25, 0.2), "often": ("twice", "four times", "five times")},
    texts=("{topic}", "{often} a second", "create_timer({period:g}, "),
))


@greeting.check(5)
def publishes_something(run: Recording) -> None:
    """The node publishes String messages on /greeting."""
    publishes(run, greeting.drawn.topic, "std_msgs/msg/String")


@greeting.check(3, after=publishes_something)
def publishes_twice_a_second(run: Recording) -> None:
    """A greeting is published twice a second."""
    rate(run, greeting.drawn.topic, 1 / greeting.drawn.period)
