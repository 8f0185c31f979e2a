"""Three topics with one callback."""

import itertools
import re

from grader.checks import Missed, subscribes
from grader.companions.random_publishers import Chatterbox
from grader.exercise import Exercise
from grader.responses import Window
from sim.evidence import LogLine, Message, Recording

CHATTERS = {
    "/chatter0": "std_msgs/msg/String",
    "/chatter1": "std_msgs/msg/Float64",
    "/chatter2": "std_msgs/msg/Bool",
}
WITHIN = 0.25  # s from a message to its log line; the next message comes later
NAMED = re.compile(r"chatter\d: \S+", re.I)
DETAILS = "details of how the message arrived where its topic should be"

chatters = Exercise("chatters", "Three topics, one callback", seconds=10, companions=[Chatterbox],
                    seeds=(1, 2))


@chatters.check(4, guess="Create one subscription for each topic, in a loop or one by one.")
def subscribes_to_all_three(run: Recording) -> None:
    """The node subscribes to /chatter0 (String), /chatter1 (Float64) and /chatter2 (Bool)."""
    for found, (topic, kind) in enumerate(CHATTERS.items()):
        try:
            subscribes(run, topic, kind)
        except Missed as missed:
            missed.credit = found / len(CHATTERS)
            raise


@chatters.check(8, after=subscribes_to_all_three, hints={
    "A callback with two parameters is given such details as the "
    "second. Pass it the topic instead: partial(self.on_message, "
    "topic=topic).": lambda run, row: _has_details(run, row),
    "Every line names /chatter2. A lambda made in a loop reads the variable when it is called, and "
    "by then the loop is over. Write `lambda msg, topic=topic: ...`, or use partial.":
        lambda run, row: row.topic != "/chatter2" and _is_logged(run, row, "/chatter2"),
    "Nothing is logged at all. Debug lines are hidden: use self.get_logger().info(...).":
        lambda run, row: not run.logs,
    "False is a value like any other, but `if msg.data:` lets only True pass: "
    "log every message, whatever its value.":
        lambda run, row: run.graph.subscriptions(row.topic) and row.message.data is False
        and not _lines_after(run, row),
}, guess='Log each message: self.get_logger().info(f"{topic}: {msg.data}").')
def knows_the_topic(run: Recording) -> None:
    """Each message is logged at info level as `chatter0: word`: its topic, a colon, a space and its value."""
    sent = [row for topic in CHATTERS for row in run.received(topic) if not _is_logged(run, row, topic)]
    missing = [next(rows) for _, rows in itertools.groupby(sent, key=lambda row: row.topic)]
    if missing:
        first, right = min(missing, key=lambda row: row.stamp), len(CHATTERS) - len(missing)
        expected = f"“{_line(first, first.topic)}” at level INFO after the message at {first.stamp:.3g} s"
        lines = ", ".join(f"“{line.text}” ({line.level})" for line in _lines_after(run, first))
        saw = DETAILS if _has_details(run, first) else lines or "no line"
        credit = right / len(CHATTERS) if right > 1 else 0.0  # a single one may be right by chance
        raise Missed(expected, saw, credit=credit, about=(first,))
    _requires_no_others(run)


@chatters.check(3, after=knows_the_topic)
def uses_one_callback(run: Recording) -> None:
    """One callback serves all three topics."""
    nodes = {end.node for topic in CHATTERS for end in run.graph.subscriptions(topic)}
    names = {ran.callback for ran in run.callbacks if ran.kind == "subscription" and ran.node in nodes}
    if len(names) > 1:
        hint = ("Write one method with a second parameter, `def on_message(self, msg, topic):`, and give it "
                "the topic with a lambda or functools.partial.")
        raise Missed("one callback for the three topics", ", ".join(sorted(names)), hint)


def _requires_no_others(run: Recording) -> None:
    """Raises Missed for a line about a message that had not come: a guess is no answer."""
    received = [row for topic in CHATTERS for row in run.received(topic)]
    for line in [line for line in run.logs if not line.from_course]:
        recent = Window(line.stamp - WITHIN, line.stamp).rows(received)
        came = tuple(_line(row, row.topic).lower() for row in recent)
        other = next((one[0] for one in NAMED.finditer(line.text) if not one[0].lower().startswith(came)), "")
        if other:
            hint = "Log in the callback, and log the message it was called with."
            saw = f"“{other}” at {line.stamp:.3g} s, although no such message had arrived"
            raise Missed("only log lines about messages that arrived", saw, hint)


def _is_logged(run: Recording, row: Message, topic: str) -> bool:
    wanted = _line(row, topic).lower()
    return any(line.level == "INFO" and wanted in line.text.lower() for line in _lines_after(run, row))


def _line(row: Message, topic: str) -> str:
    return f"{topic.lstrip('/')}: {row.message.data}"


def _lines_after(run: Recording, row: Message) -> list[LogLine]:
    return Window.after(row.stamp, WITHIN).rows(run.logs)


def _has_details(run: Recording, row: Message) -> bool:
    """Return whether the message info of rclpy is logged, which a callback's second parameter is given."""
    return any("source_timestamp" in line.text for line in _lines_after(run, row))
