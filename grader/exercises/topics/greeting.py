"""A publisher in one line."""

from grader.checks import publishes, rate
from grader.exercise import Exercise
from sim.evidence import Recording

greeting = Exercise("greeting", "A publisher in one line", seconds=5)


@greeting.check(5)
def publishes_something(run: Recording) -> None:
    """The node publishes String messages on /greeting."""
    publishes(run, "/greeting", "std_msgs/msg/String")


@greeting.check(3, after=publishes_something)
def publishes_twice_a_second(run: Recording) -> None:
    """A greeting is published twice a second."""
    rate(run, "/greeting", 2.0)
