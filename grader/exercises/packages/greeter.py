"""A package from scratch: three files, and what colcon makes of them."""

from functools import partial

from grader.checks import Missed, publishes, rate
from grader.checks.packages import installs_by_itself, names_what_it_imports, starts_a_node
from grader.exercise import Exercise, Scenario
from grader.variants import Variants
from grader.workspace.installation import ros2_run
from grader.workspace.near_misses import commas, entry_points
from grader.workspace.package import PackageRun

greeter = Exercise("greeter", "A package from scratch", package="greeter",
                   scenarios=[Scenario(seconds=6, prepare=partial(ros2_run, "greeter", "hello"))],
                   near_misses=[commas, partial(entry_points, commands=["hello"])], variants=Variants(
    {"topic": ("greeting", "welcome")},
    {"period": (0.5, 0.25, 0.2), "rate": (2.0, 4.0, 5.0), "often": ("twice", "four times", "five times"),
     "every": ("half second", "quarter of a second", "fifth of a second")},
    texts=("/{topic}", '"{topic}"', "every {every}", "create_timer({period}, ", "{often} a second"),
))


@greeter.check(5, guess="Compare the topic's name with the task, letter by letter.")
def publishes_hello(run: PackageRun) -> None:
    """`ros2 run greeter hello` publishes String messages on /greeting."""
    publishes(run, f"/{greeter.drawn.topic}", "std_msgs/msg/String")


@greeter.check(3, after=publishes_hello)
def twice_a_second(run: PackageRun) -> None:
    """A greeting comes twice a second."""
    rate(run, f"/{greeter.drawn.topic}", greeter.drawn.rate)


@greeter.check(2, after=publishes_hello)
def counts(run: PackageRun) -> None:
    """The greetings are hello 1, hello 2, hello 3 and so on."""
    for number, row in enumerate(run.messages(f"/{greeter.drawn.topic}"), 1):
        if row.message.data != f"hello {number}":
            hint = "Keep a count in the node: start at 1, and add 1 after each message."
            raise Missed(f"“hello {number}”", f"“{row.message.data[:60]}” at {row.stamp:g} s", hint)


@greeter.check(3)
def names_its_needs(run: PackageRun) -> None:
    """package.xml names every ROS package that the program imports."""
    starts_a_node(run)
    names_what_it_imports(run)


@greeter.check(3)
def brings_its_description(run: PackageRun) -> None:
    """setup.py installs package.xml, and the marker that lets ROS find the package."""
    starts_a_node(run)
    installs_by_itself(run)
