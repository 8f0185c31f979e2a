"""A module of one's own, imported from a node by the package's name."""

from __future__ import annotations

import ast
import functools
import random

from rclpy.node import Node
from std_msgs.msg import Float32

from grader.checks import Missed, publishes
from grader.checks.no_data import no_data
from grader.exercise import Exercise, Scenario
from grader.exercises.packages.looks import ROS, imports, package_of, parsed
from grader.workspace import place
from grader.workspace.package import PackageRun

VOLTS, DEGREES = "/volts", "/celsius"
MODULE, PLACE = "gauge.convert", "gauge/gauge/convert.py"
BY_ITS_NAME = "Write `from gauge.convert import celsius`, and call celsius(...) where a message comes."
SOON, SAME = 0.3, 0.05  # s, degrees


class Probe(Node):
    """Says voltages (Float32 on /volts), four times a second; some are out of range."""

    def __init__(self, seed: int) -> None:
        super().__init__("probe")
        chance = random.Random(f"probe {seed}")
        self.left = [round(chance.uniform(0.0, 3.3), 3) for _ in range(60)]
        for _ in range(12):
            self.left[chance.randrange(50, 60)] = chance.choice([-0.2, -0.01, 3.35, 5.0])
        self.publisher = self.create_publisher(Float32, VOLTS, 10)
        self.create_timer(0.25, self.say)

    def say(self) -> None:
        """The next one."""
        self.publisher.publish(Float32(data=self.left.pop()))


gauge = Exercise(
    "gauge",
    "A module of your own",
    package="gauge",
    scenarios=[
        Scenario(
            seconds=6,
            prepare=functools.partial(place.program, "gauge", "gauge"),
            companions=lambda seed: [functools.partial(Probe, seed)],
        )
    ],
)


@gauge.check(3, guess="Compare the topic's name with the task, letter by letter.")
def publishes_degrees(run: PackageRun) -> None:
    """`ros2 run gauge gauge` publishes Float32 messages on /celsius."""
    publishes(run, DEGREES, "std_msgs/msg/Float32")


@gauge.check(5, after=publishes_degrees)
def converts(run: PackageRun) -> None:
    """Each voltage becomes 100 degrees for each volt, less 50; and none comes for one outside 0 to 3.3 V."""
    heard = [one for one in run.messages(VOLTS) if one.from_course and one.stamp + SOON < run.seconds]
    if not heard:
        raise no_data(run, f"voltages on {VOLTS}", "none", run.graph.publishers(VOLTS))
    for one in heard:
        volts = one.message.data
        said = [it for it in run.messages(DEGREES) if one.stamp <= it.stamp < one.stamp + 0.2]
        saw = f"{said[0].message.data:.1f}" if said else "nothing"
        if not 0.0 <= volts <= 3.3:
            if said:
                hint = "Such a voltage means a broken cable: leave it out."
                raise Missed(f"nothing for {volts:.2f} V", saw, hint)
            continue
        wanted = 100.0 * volts - 50.0
        if not said or abs(said[0].message.data - wanted) > SAME:
            raise Missed(f"{wanted:.1f} for {volts:.3f} V", saw, "celsius(volts) is 100 * volts - 50.")


@gauge.check(5)
def has_a_module(run: PackageRun) -> None:
    """The conversion is the function celsius in gauge/convert.py, and the node's module imports it."""
    sources = package_of(run).sources
    nodes = ast.walk(parsed(sources.get(PLACE, b"")))
    names = [node.name for node in nodes if isinstance(node, ast.FunctionDef)]
    if "celsius" not in names:
        saw = f"{', '.join(names) or 'no function'} there" if PLACE in sources else "no such file"
        raise Missed(f"a function celsius in ws/src/{PLACE}", saw, "Put the arithmetic there, and only that.")
    found = {
        name
        for path, data in sources.items()
        if path.startswith("gauge/gauge/") and path != PLACE
        for name in imports(data)
    }
    if not found & {MODULE, f"{MODULE}.celsius", ".convert", ".convert.celsius"}:
        saw = "no module of the package that imports it"
        raise Missed(f"an import of {MODULE}", saw, BY_ITS_NAME)


@gauge.check(3, after=has_a_module)
def module_is_plain(run: PackageRun) -> None:
    """gauge/convert.py knows nothing of ROS: whoever tests it needs no robot."""
    found = [name for name in imports(package_of(run).sources[PLACE]) if ROS.fullmatch(name.split(".")[0])]
    if found:
        hint = "Give the function a number, and let it return one. Messages stay in the node."
        raise Missed("no import of ROS in convert.py", found[0], hint)
