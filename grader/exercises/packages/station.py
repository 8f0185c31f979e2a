"""Entry points: names for the functions that a package's programs start with."""

from functools import partial

from grader.checks import Missed, publishes, rate
from grader.checks.packages import package_of, starts_a_node
from grader.companions.package_sensors import TEMPERATURE, WeatherStation
from grader.exercise import Exercise, Scenario
from grader.responses import Stimuli
from grader.workspace.installation import ros2_run
from grader.workspace.near_misses import commas, entry_points
from grader.workspace.package import PackageRun

SHOWN = "/display"
COMMANDS = ("display", "sensor")
SOON = 0.3  # s

station = Exercise("station", "Names for two programs", package="station", scenarios=[
    Scenario(seconds=4, name="sensor", prepare=partial(ros2_run, "station", "sensor")),
    Scenario(seconds=5, name="display", prepare=partial(ros2_run, "station", "display"),
             companions=lambda seed: [partial(WeatherStation, seed)]),
], near_misses=[commas, partial(entry_points, commands=COMMANDS)])
temperatures = Stimuli(TEMPERATURE, answered_on=SHOWN, within=SOON, what="temperatures on /temperature")


@station.check(5, only="sensor")
def measures(run: PackageRun) -> None:
    """`ros2 run station sensor` starts the sensor: a Float32 on /temperature, five times a second."""
    publishes(run, TEMPERATURE, "std_msgs/msg/Float32")
    rate(run, TEMPERATURE, 5.0)


@station.check(5, only="display")
def shows(run: PackageRun) -> None:
    """`ros2 run station display` starts the display: each /temperature appears on /display as text."""
    publishes(run, SHOWN, "std_msgs/msg/String")
    for temperature in temperatures(run):
        text = f"{temperature.value.data:.1f}"
        if not any(text in shown for shown in temperature.values()):
            saw = temperature.seen() if not temperature.responses else f"“{temperature.values()[0][:60]}”"
            raise Missed(f"a text with {text} within {SOON:g} s", saw,
                         "Start the original programs, unchanged.")


@station.check(5)
def has_these_commands(run: PackageRun) -> None:
    """The package has these two commands and no others."""
    starts_a_node(run)
    programs = package_of(run).built.programs
    found = sorted(path.rpartition("/")[2] for path in programs if path.startswith("lib/station/"))
    others = [name for name in found if name not in COMMANDS]
    if others or len(found) != len(COMMANDS):
        hint = "Write one line in 'console_scripts' for each command, and none for anything else."
        raise Missed(f"the commands {' and '.join(COMMANDS)}", ", ".join(found) or "none", hint)
