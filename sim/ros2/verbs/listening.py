"""ros2 topic echo, hz, bw and delay: what comes on a topic, how often, how much of it and how late."""

from __future__ import annotations

from argparse import ArgumentTypeError, Namespace
from collections.abc import Iterator

from rclpy.qos import QoSProfile, qos_profile_sensor_data

from sim.ros.messages.decoder import decode
from sim.ros2.group import argument, flag
from sim.ros2.measures import Bandwidth, Delay, Measure, Rate
from sim.ros2.qos_words import QOS, asked_profile
from sim.ros2.system import Arrived, System, Wrong, guess
from sim.ros2.text import Style, as_csv, as_yaml
from sim.ros2.types import existing
from sim.ros2.verbs.topic import NAME, topic, types_of


def positive(word: str) -> int:
    """A whole number above 0, for an option."""
    if not word.isdecimal() or not int(word):
        raise ArgumentTypeError("value must be a positive integer")
    return int(word)


def window(default: int) -> tuple:
    """The option for how many messages are looked at."""
    text = f"window size, in # of messages (default: {default})"
    return argument("-w", "--window", type=positive, default=default, metavar="WINDOW", help=text)


@topic.verb("hz", NAME, window(10000))
def hz(system: System, asked: Namespace) -> None:
    """Print the average publishing rate to screen."""
    _measure(system, asked.topic_name, Rate(asked.window))


@topic.verb("bw", NAME, window(100))
def bw(system: System, asked: Namespace) -> None:
    """Display bandwidth used by topic."""
    _measure(system, asked.topic_name, Bandwidth(asked.window))


@topic.verb("delay", NAME, window(10000))
def delay(system: System, asked: Namespace) -> None:
    """Display delay of topic from timestamp in header."""
    _measure(system, asked.topic_name, Delay(asked.window, system.epoch))


def _measure(system: System, name: str, measure: Measure) -> None:
    """Show what a measure says, every second, or once of a run that is over."""
    name, type_ = _awaited(system, name)
    if measure.begin:
        system.say(measure.begin.format(name))
    heard = False
    for arrived in system.listen({name: type_}, qos_profile_sensor_data):
        if arrived is not None:
            heard = True
            measure.add(arrived)
        if system.over or (arrived is None and system.window is not None):
            continue  # a play's time goes on in leaps
        if text := measure.due(system.now if arrived is None else arrived.stamp):
            system.say(text)
    if system.over and (text := measure.text(system.now)):
        system.say(text)
    elif not heard:
        system.say(_silence(system, name))


def _silence(system: System, name: str) -> str:
    while_ = "in this run" if system.over else f"within {system.window:g} s of the play"
    return f"No message came on {name} {while_}."


def _awaited(system: System, name: str) -> tuple[str, str]:
    """The full name and the type of a topic, for which this waits where it may still come."""
    name = name if name.startswith("/") else f"/{name}"
    known = system.look_for(name, lambda: system.topics(hidden=True))
    if name not in known:
        system.say(f"WARNING: topic [{name}] does not appear to be published yet{guess(name, known)}")
        for _ in system.listen({}):
            if name in (known := system.topics(hidden=True)):
                break
    return name, _only_type(name, known)


def _only_type(name: str, known: dict[str, list[str]]) -> str:
    types = known.get(name, [])
    if len(types) > 1:
        raise Wrong(f"Cannot echo topic '{name}', as it contains more than one type: [{', '.join(types)}]")
    if not types:
        raise Wrong("Could not determine the type for the passed topic")
    return existing(types[0])


@topic.verb(
    "echo",
    NAME,
    argument(
        "message_type",
        nargs="?",
        help="Type of the ROS message (e.g. 'std_msgs/msg/String')",
        offers=types_of,
    ),
    *QOS,
    flag("--csv", help="Output all recursive fields separated by commas (e.g. for plotting)"),
    argument("--field", help="Echo a selected field of a message; '.' selects sub-fields"),
    flag("-f", "--full-length", help="Output all elements of arrays, bytes and strings"),
    argument("-l", "--truncate-length", type=positive, default=128, help="Their length otherwise"),
    flag("--no-arr", help="Don't print array fields of messages"),
    flag("--no-str", help="Don't print string fields of messages"),
    flag("--flow-style", help="Print collections in one line"),
    flag("--raw", help="Echo the raw binary representation"),
    argument("--filter", metavar="EXPR", help="Only messages m of which this Python expression is true"),
    flag("--once", help="Print the first message received and then exit."),
    argument("--timeout", metavar="N", type=float, help="Set a timeout in seconds for waiting"),
)
def echo(system: System, asked: Namespace) -> None:
    """Output messages from a topic."""
    name = asked.topic_name if asked.topic_name.startswith("/") else f"/{asked.topic_name}"
    given = {name: [asked.message_type]} if asked.message_type else {}
    known = given or system.look_for(name, lambda: system.topics(hidden=True))
    if name not in known:
        system.say(f"WARNING: topic [{name}] does not appear to be published yet{guess(name, known)}")
    type_ = _only_type(name, known)
    profile = asked_profile(asked, "sensor_data")
    shown = 0
    for arrived in _in_time(system, name, type_, profile, asked.timeout):
        text = _shown(arrived, asked)
        if text is None:
            continue
        system.say(text)
        shown += 1
        if asked.once:
            return
        if shown == system.most:
            system.say(f"... the first {shown} messages; in Python, recording.messages({name!r}) has all")
            return
    if not shown and not asked.timeout:
        system.say(_silence(system, name))


def _in_time(
    system: System, name: str, type_: str, profile: QoSProfile | None, timeout: float | None
) -> Iterator[Arrived]:
    """The messages that come before the time is over."""
    began = system.now
    for arrived in system.listen({name: type_}, profile):
        if arrived is not None:
            yield arrived
        if timeout and not system.over and system.now - began >= timeout:
            return


def _shown(arrived: Arrived, asked: Namespace) -> str | None:
    """How a message is shown; None where it isn't."""
    if asked.raw:
        return f"{arrived.raw!r}\n---"
    value = decode(arrived.type, arrived.raw)
    for part in filter(None, (asked.field or "").split(".")):
        try:
            value = getattr(value, part)
        except AttributeError as error:
            raise Wrong(f"Invalid field '{asked.field}': {error}") from None
    if asked.filter and not _true(asked.filter, value):
        return None
    if not hasattr(value, "SLOT_TYPES"):
        return f"{value}\n---"
    length = None if asked.full_length else asked.truncate_length
    style = Style(length, asked.no_arr, asked.no_str, asked.flow_style)
    return as_csv(value, style) if asked.csv else f"{as_yaml(value, style)}---"


def _true(expression: str, message: object) -> bool:
    try:
        return bool(eval(expression, {"m": message}))  # the user's own words, in the user's own process
    except Exception as error:
        raise Wrong(f"--filter {expression!r} fails: {type(error).__name__}: {error}") from None
