"""The node of the exercise before, started with another speed."""

from grader.checks import Missed
from grader.companions.service_clients import Reader
from grader.exercise import Exercise
from grader.exercises.settings.parameters import begins_with, declares_speed
from grader.variants import Variants
from sim.evidence import Recording

launch = Exercise("launch", "The same node, with another speed", world="yard", seconds=4,
                  companions=[Reader], variants=Variants(
    {"speed": (0.3, 0.35, 0.4)},
    texts=("speed:={speed:g}", "set to {speed:g}", '"speed": {speed:g}', "{speed:g} m/s",
           "speed of {speed:g}"),
))


@launch.check(1)
def launches_the_cruiser(run: Recording) -> float:
    """The node /cruiser runs, and has its parameter `speed`."""
    if all(map(run.is_course_node, run.graph.nodes)):
        hint = "launch returns what should be started: return Process(...), with Cruiser in it."
        raise Missed("a node called /cruiser", "no node was started", hint)
    return float(declares_speed(run))


@launch.check(2, after=launches_the_cruiser,
              guess='In launch: return Process(Cruiser, parameters={"speed": 0.3}).')
def is_launched_with_a_speed(run: Recording, speed: float) -> None:
    """It is started with a speed of 0.3, and drives at that speed."""
    begins_with(run, speed, launch.drawn.speed)
