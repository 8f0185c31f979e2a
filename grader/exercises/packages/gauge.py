"""A module of one's own, imported by the package's name."""

import ast
from functools import partial

from grader.checks import Missed, publishes
from grader.checks.packages import ROS, imports, package_of, parsed
from grader.companions.package_sensors import EDGES, VOLTS, VoltageProbe
from grader.exercise import Exercise, Scenario
from grader.responses import Stimuli, same
from grader.variants import Variants
from grader.workspace.installation import ros2_run
from grader.workspace.near_misses import commas, entry_points
from grader.workspace.package import PackageRun

DEGREES = "/celsius"
MODULE, PLACE = "gauge.convert", "gauge/gauge/convert.py"
BY_ITS_NAME = "Write `from gauge.convert import celsius`, and call celsius(...) in the callback."
EDGE = "0 V and 3.3 V are in range, and 0 degrees is a temperature: test `if value is not None:`."
SOON, SAME = 0.2, 0.05  # s, degrees

gauge = Exercise("gauge", "A module of your own", package="gauge", scenarios=[
    Scenario(seconds=6, prepare=partial(ros2_run, "gauge", "gauge"),
             companions=lambda seed: [partial(VoltageProbe, seed)]),
], near_misses=[commas, partial(entry_points, commands=["gauge"])], variants=Variants(
    {"slope": (100, 80, 60), "offset": (50, 40, 30)},  # all give 0 degrees for 0.5 V, which the probe sends
    texts=("{slope} degrees per volt, minus {offset}", "{slope}.0 * volts - {offset}.0",
           "{slope} times the voltage, minus {offset}"),
))
voltages = Stimuli(VOLTS, answered_on=DEGREES, within=SOON, what="voltages on /volts")


@gauge.check(3, guess="Compare the topic's name with the task, letter by letter.")
def publishes_degrees(run: PackageRun) -> None:
    """`ros2 run gauge gauge` publishes Float32 messages on /celsius."""
    publishes(run, DEGREES, "std_msgs/msg/Float32")


@gauge.check(5, after=publishes_degrees)
def converts(run: PackageRun) -> None:
    """Celsius is 100 times the voltage, minus 50; a voltage outside 0 to 3.3 V gives no message."""
    drawn = gauge.drawn
    for voltage in voltages(run):
        volts, found = voltage.value.data, voltage.values()
        degrees = float(drawn.slope) * volts - drawn.offset
        saw = f"{found[0]:.1f}" if found else "nothing"
        if not 0.0 <= volts <= 3.3:
            hint = "Such a voltage means a broken cable: leave it out."
            voltage.expects_nothing(f"nothing for {volts:.2f} V", hint, saw=saw)
        elif not found or not same(found[0], degrees, SAME):
            hint = f"celsius(volts) is {drawn.slope} * volts - {drawn.offset}."
            if not found and any(same(volts, edge, 1e-6) for edge in EDGES):
                hint = EDGE
            raise Missed(f"{degrees:.1f} for {volts:.3f} V", saw, hint)


@gauge.check(5)
def has_a_module(run: PackageRun) -> None:
    """The conversion is the function celsius in gauge/convert.py, and the node's module imports it."""
    sources, programs = package_of(run).sources, package_of(run).built.programs
    nodes = list(ast.walk(parsed(sources.get(PLACE, b""))))
    names = [node.name for node in nodes if isinstance(node, ast.FunctionDef)]
    if "celsius" not in names:
        saw = f"{', '.join(names) or 'no function'} there" if PLACE in sources else "no such file"
        raise Missed(f"a function celsius in ws/src/{PLACE}", saw,
                     "Put the arithmetic there, and nothing else.")
    if not any(isinstance(node, ast.BinOp) for node in nodes):
        hint = f"Return {gauge.drawn.slope} * volts - {gauge.drawn.offset}."
        raise Missed(f"the conversion in ws/src/{PLACE}", "no arithmetic there", hint)
    if not any(path.startswith("lib/gauge/") for path in programs):
        raise Missed("a program", "none")  # the error of `ros2 run` explains it
    modules = [path for path in sources if path.startswith("gauge/gauge/") and path != PLACE]
    found = {name for path in modules for name in imports(sources[path])}
    if not found & {MODULE, f"{MODULE}.celsius", ".convert", ".convert.celsius"}:
        saw = "no module of the package that imports it"
        raise Missed(f"an import of {MODULE}", saw, BY_ITS_NAME)


@gauge.check(3, after=has_a_module)
def module_is_plain(run: PackageRun) -> None:
    """gauge/convert.py doesn't use ROS: it can be tested without a robot."""
    found = [name for name in imports(package_of(run).sources[PLACE]) if ROS.fullmatch(name.split(".")[0])]
    if found:
        hint = "The function takes a number and returns a number. Leave the messages to the node."
        raise Missed("no import of ROS in convert.py", found[0], hint)
