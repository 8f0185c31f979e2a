"""ros2 topic echo, hz, bw and delay: messages of a topic, and their rate, bandwidth and delay."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from rclpy.qos import QoSProfile, qos_profile_sensor_data

from sim.ros2.group import Argument, argument, flag
from sim.ros2.interface_types import installed_type
from sim.ros2.print_options import PRINTING, positive_int, style_of
from sim.ros2.qos_options import QOS, profile_from_options
from sim.ros2.system import CliError, ReceivedMessage, System, suggestion
from sim.ros2.text import as_csv, as_yaml
from sim.ros2.topic_statistics import Bandwidth, Delay, Rate, TopicStatistic
from sim.ros2.verbs.topic import NAME, topic, types_of


def window(default: int) -> Argument:
    """The option for the number of messages in the window."""
    text = f"window size, in # of messages (default: {default})"
    return argument("-w", "--window", type=positive_int, default=default, metavar="WINDOW", help=text)


@topic.verb(
    "hz",
    NAME,
    window(10000),
    argument("--filter", metavar="EXPR", help="Only measure messages m for which this is true"),
    flag("--wall-time", help="Changes nothing: a terminal measures wall time, and a cell its play's"),
)
def hz(system: System, options: Namespace) -> None:
    """Print the average publishing rate to screen."""
    _print_statistic(system, options.topic_name, Rate(options.window), options.filter)


@topic.verb("bw", NAME, window(100))
def bw(system: System, options: Namespace) -> None:
    """Display bandwidth used by topic."""
    _print_statistic(system, options.topic_name, Bandwidth(options.window))


@topic.verb("delay", NAME, window(10000))
def delay(system: System, options: Namespace) -> None:
    """Display delay of topic from timestamp in header."""
    _print_statistic(system, options.topic_name, Delay(options.window, system.epoch))


def _print_statistic(
    system: System, name: str, statistic: TopicStatistic, expression: str | None = None
) -> None:
    """Print a statistic every second or, of a recording, once. expression: which messages count."""
    name, type_ = _wait_for_topic(system, name)
    if statistic.header:
        system.print_line(statistic.header.format(name))
    received = False
    for message in system.subscribe({name: type_}, qos_profile_sensor_data):
        if message is not None and (expression is None or _matches(expression, _decoded(message))):
            received = True
            statistic.add(message)
        if system.finished or (message is None and system.time_limit is not None):
            continue  # a player's time advances frame by frame
        if text := statistic.due(system.now if message is None else message.stamp):
            system.print_line(text)
    if system.finished and (text := statistic.text(system.now)):
        system.print_line(text)
    elif not received:
        system.print_line(_no_message(system, name))


def _no_message(system: System, name: str) -> str:
    when = "in this run" if system.finished else f"within {system.time_limit:g} s of the play"
    return f"No message arrived on {name} {when}."


def _wait_for_topic(system: System, name: str) -> tuple[str, str]:
    """The full name and the type of a topic; waits for the topic if it may still be created."""
    name = name if name.startswith("/") else f"/{name}"
    known = system.look_up(name, lambda: system.topics(hidden=True))
    if name not in known:
        system.print_line(
            f"WARNING: topic [{name}] does not appear to be published yet{suggestion(name, known)}"
        )
        for _ in system.subscribe({}):
            if name in (known := system.topics(hidden=True)):
                break
    return name, _only_type(name, known)


def _only_type(name: str, known: dict[str, list[str]]) -> str:
    types = known.get(name, [])
    if len(types) > 1:
        raise CliError(f"Cannot echo topic '{name}', as it contains more than one type: [{', '.join(types)}]")
    if not types:
        raise CliError("Could not determine the type for the passed topic")
    return installed_type(types[0])


@topic.verb(
    "echo",
    NAME,
    argument(
        "message_type",
        nargs="?",
        help="Type of the ROS message (e.g. 'std_msgs/msg/String')",
        completer=types_of,
    ),
    *QOS,
    argument("--field", help="Echo a selected field of a message; '.' selects sub-fields"),
    *PRINTING,
    flag("--no-lost-messages", help="Changes nothing: lost messages are not reported"),
    flag("--raw", help="Echo the raw binary representation"),
    argument("--filter", metavar="EXPR", help="Only messages m for which this Python expression is true"),
    flag("--once", help="Print the first message received and then exit."),
    argument("--timeout", metavar="N", type=float, help="Set a timeout in seconds for waiting"),
)
def echo(system: System, options: Namespace) -> None:
    """Output messages from a topic."""
    name = options.topic_name if options.topic_name.startswith("/") else f"/{options.topic_name}"
    given = {name: [options.message_type]} if options.message_type else {}
    known = given or system.look_up(name, lambda: system.topics(hidden=True))
    if name not in known:
        system.print_line(
            f"WARNING: topic [{name}] does not appear to be published yet{suggestion(name, known)}"
        )
    type_ = _only_type(name, known)
    profile = profile_from_options(options, "sensor_data")
    shown = 0
    for message in _messages(system, name, type_, profile, options.timeout):
        text = _format(message, options)
        if text is None:
            continue
        system.print_line(text)
        shown += 1
        if options.once:
            return
        if shown == system.max_messages:
            system.print_line(
                f"... the first {shown} messages; in Python, recording.messages({name!r}) has all"
            )
            return
    if not shown and not options.timeout:
        system.print_line(_no_message(system, name))


def _messages(
    system: System, name: str, type_: str, profile: QoSProfile | None, timeout: float | None
) -> Iterator[ReceivedMessage]:
    """The messages that arrive before the timeout."""
    began = system.now
    for message in system.subscribe({name: type_}, profile):
        if message is not None:
            yield message
        if timeout and not system.finished and system.now - began >= timeout:
            return


def _format(message: ReceivedMessage, options: Namespace) -> str | None:
    """A message as text; None if the filter excludes it."""
    if options.raw:
        return f"{message.raw!r}\n---"
    value = _decoded(message)
    for part in filter(None, (options.field or "").split(".")):
        try:
            value = getattr(value, part)
        except AttributeError as error:
            raise CliError(f"Invalid field '{options.field}': {error}") from None
    if options.filter and not _matches(options.filter, value):
        return None
    if not hasattr(value, "SLOT_TYPES"):
        return f"{value}\n---"
    style = style_of(options)
    return as_csv(value, style) if options.csv else f"{as_yaml(value, style)}---"


def _decoded(message: ReceivedMessage) -> Any:
    from sim.ros.messages.decoder import decode  # imported late, because numpy is slow

    return decode(message.type, message.raw)


def _matches(expression: str, message: object) -> bool:
    try:
        return bool(eval(expression, {"m": message}))  # the user's own expression, in the user's own process
    except Exception as error:
        raise CliError(f"--filter {expression!r} fails: {type(error).__name__}: {error}") from None
