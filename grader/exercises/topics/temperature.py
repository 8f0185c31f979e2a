"""A thermometer: a timer, a message, a number in a range."""

import itertools

from grader.checks import Missed, publishes, rate, within
from grader.exercise import Exercise
from grader.variants import Variants
from sim.evidence import Message, Recording

temperature = Exercise("temperature", "A thermometer", seconds=10, variants=Variants(
    {"topic": ("/sensor/temperature", "/room/temperature", "/lab/temperature")},
    {"low": (20, 15, 30), "high": (25, 18, 36)},
    texts=("{topic}", "from {low} to {high}", "between {low} and {high}", "uniform({low}.0, {high}.0)"),
))


@temperature.check(5)
def temperature_is_published(run: Recording) -> list[Message]:
    """The node publishes Float32 messages on /sensor/temperature."""
    return publishes(run, temperature.drawn.topic, "std_msgs/msg/Float32")


@temperature.check(4, after=temperature_is_published)
def temperature_once_a_second(run: Recording) -> None:
    """A temperature comes once a second."""
    rate(run, temperature.drawn.topic, 1.0)


@temperature.check(4, after=temperature_is_published,
                   guess="random.uniform(20.0, 25.0) gives a number in this range.")
def temperature_in_range(run: Recording) -> list[float]:
    """Every temperature is from 20 to 25 °C."""
    drawn = temperature.drawn
    return within(run, drawn.topic, "data", float(drawn.low), float(drawn.high), unit="°C")


@temperature.check(2, after=(temperature_is_published, temperature_in_range))
def temperature_changes(run: Recording, sent: list[Message], _: list[float]) -> None:
    """The temperature changes from message to message."""
    values = [row.message.data for row in sent]
    same = sum(before == after for before, after in itertools.pairwise(values))
    if len(values) < 2 or same > len(values) / 2:
        repeated = f"{same} times the same value as before"
        saw = f"only {values[0]:.4g} °C" if len(set(values)) == 1 else repeated
        draw = f"random.uniform({temperature.drawn.low}.0, {temperature.drawn.high}.0)"
        hint = f"Draw a new number in the timer's callback, each time: {draw}."
        raise Missed("a new temperature in each message", saw, hint)
