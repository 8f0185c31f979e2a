"""A program in scripts/ moves into its package, and the build prints no warning any more."""

from functools import partial

from grader.checks import Missed, hinting, otherwise, publishes
from grader.checks.packages import builds_without_warnings, imports_by_its_name, installs_only_its_name
from grader.companions.package_sensors import TICKS, WheelEncoder
from grader.exercise import Exercise, Scenario
from grader.exercises.testing.odometer.odometer_package import AROUND, PER_TURN, rearranged
from grader.responses import Stimuli, same
from grader.workspace.installation import ros2_run
from grader.workspace.near_misses import commas, entry_points
from grader.workspace.package import PackageRun

__all__ = ["odometer", "rearranged"]

DISTANCE = "/distance"
SOON, SAME = 0.2, 1e-6  # s, m

odometer = Exercise("odometer", "A program moved out of scripts/", package="odometer", scenarios=[
    Scenario(seconds=5, prepare=partial(ros2_run, "odometer", "odometer"),
             companions=lambda seed: [partial(WheelEncoder, seed)]),
], near_misses=[commas, partial(entry_points, commands=["odometer"])])
counts = Stimuli(TICKS, answered_on=DISTANCE, within=SOON, what="counts on /ticks")


@odometer.check(2)
def publishes_distances(run: PackageRun) -> None:
    """`ros2 run odometer odometer` publishes Float64 messages on /distance."""
    with hinting(guess="The program worked in scripts/: move it as it is, names of topics included."):
        publishes(run, DISTANCE, "std_msgs/msg/Float64")


@odometer.check(1, after=publishes_distances)
def measures(run: PackageRun) -> None:
    """Each count on /ticks is answered with the distance in meters."""
    for count in counts(run):
        wanted, found = AROUND * count.value.data / PER_TURN, count.values()
        if not found or not same(found[0], wanted, SAME):
            saw = f"{found[0]:.3f} m" if found else "nothing"
            hint = "The helper worked in helpers/: move it as it is, and call meters(...)."
            raise Missed(f"{wanted:.3f} m for {count.value.data} ticks", saw, hint)


@odometer.check(2, after=publishes_distances)
def has_its_own_name(run: PackageRun) -> None:
    """All Python code that is installed is in the package `odometer`: nothing else is at the top."""
    installs_only_its_name(run)


@odometer.check(1, after=has_its_own_name)
def imports_by_name(run: PackageRun) -> None:
    """The helper is imported by the package's name, and `sys.path` stays as it is."""
    imports_by_its_name(run)


@odometer.check(2, after=publishes_distances, hints={
    "setuptools doesn't know this option of setup.py, and ignores it. What is its name today?":
        lambda run, warning: "distribution option" in warning,
    "In setup.cfg, write the key with an underscore instead of a dash.":
        lambda run, warning: "dash-separated" in warning,
    "Fix what it warns about. A filter also hides the next warning.":
        lambda run, warning: not warning,
    "Find what the warning names, in setup.py or setup.cfg.": otherwise,
})
def builds_quietly(run: PackageRun) -> None:
    """`colcon build` prints no warning."""
    builds_without_warnings(run)
