"""Entry points: names for functions, by which a package's programs are started."""

from __future__ import annotations

import functools
import random

from rclpy.node import Node
from std_msgs.msg import Float32

from grader.checks import Missed, publishes, rate
from grader.checks.no_data import no_data
from grader.exercise import Exercise, Scenario
from grader.exercises.packages.looks import package_of
from grader.workspace import place
from grader.workspace.package import PackageRun

HEARD, SHOWN = "/temperature", "/display"
COMMANDS = ("display", "sensor")
SOON = 0.3  # s


class Weather(Node):
    """Says temperatures (Float32 on /temperature), twice a second, and none of them twice."""

    def __init__(self, seed: int) -> None:
        super().__init__("weather")
        chance = random.Random(f"weather {seed}")
        self.left = [chance.randrange(-200, 400) / 10 for _ in range(100)]
        self.publisher = self.create_publisher(Float32, HEARD, 10)
        self.create_timer(0.5, self.say)

    def say(self) -> None:
        """The next one."""
        self.publisher.publish(Float32(data=self.left.pop()))


station = Exercise(
    "station",
    "Names for two programs",
    package="station",
    scenarios=[
        Scenario(seconds=4, name="sensor", prepare=functools.partial(place.program, "station", "sensor")),
        Scenario(
            seconds=5,
            name="display",
            prepare=functools.partial(place.program, "station", "display"),
            companions=lambda seed: [functools.partial(Weather, seed)],
        ),
    ],
)


@station.check(5, only="sensor")
def measures(run: PackageRun) -> None:
    """`ros2 run station sensor` starts the sensor: a Float32 on /temperature, five times a second."""
    publishes(run, HEARD, "std_msgs/msg/Float32")
    rate(run, HEARD, 5.0)


@station.check(5, only="display")
def shows(run: PackageRun) -> None:
    """`ros2 run station display` starts the display: each /temperature comes on /display as a text."""
    publishes(run, SHOWN, "std_msgs/msg/String")
    heard = [one for one in run.messages(HEARD) if one.from_course and one.stamp + SOON < run.seconds]
    if not heard:
        raise no_data(run, f"temperatures on {HEARD}", "none", run.graph.publishers(HEARD))
    for one in heard:
        text = f"{one.message.data:.1f}"
        answers = [it for it in run.messages(SHOWN) if one.stamp <= it.stamp <= one.stamp + SOON]
        if not any(text in it.message.data for it in answers):
            saw = f"“{answers[0].message.data[:60]}”" if answers else "nothing"
            raise Missed(f"a text with {text} within {SOON:g} s", saw, "Start what was there, unchanged.")


@station.check(5)
def has_these_commands(run: PackageRun) -> None:
    """The package has these two commands and no other."""
    programs = package_of(run).built.programs
    found = sorted(path.rpartition("/")[2] for path in programs if path.startswith("lib/station/"))
    others = [name for name in found if name not in COMMANDS]
    if others or len(found) != len(COMMANDS):
        raise Missed(
            f"the commands {' and '.join(COMMANDS)}",
            ", ".join(found) or "none",
            "One line in 'console_scripts' for each command, and none for what isn't one.",
        )
