"""A robot that obeys commands, and reports each with its own log line."""

from typing import Any

from grader.checks import Missed, answers, subscribes
from grader.companions.random_publishers import COMMANDS, CommandSender
from grader.exercise import Exercise
from grader.responses import Window
from sim.evidence import LogLine, Message, Recording

COMMAND = "/robot/command"
DOING = dict(zip(COMMANDS, ("standing", "walking", "stopping"), strict=True))
WITHIN = 0.25  # s from a message to its log line; the next message comes later
PRINTED = "print(...) doesn't log anything: use self.get_logger() instead."

commands = Exercise("commands", "A robot that listens", seconds=10, companions=[CommandSender], seeds=(1, 2))


@commands.check(3)
def subscribes_to_commands(run: Recording) -> None:
    """The node subscribes to String messages on /robot/command."""
    subscribes(run, COMMAND, "std_msgs/msg/String")


@commands.check(6, after=subscribes_to_commands, guess={
    PRINTED: lambda run: run.prints,
    "The word is in msg.data. Compare it with ==, and log with self.get_logger().info(...).":
        lambda run: True,
})
def obeys(run: Recording) -> None:
    """`stand`, `walk` and `stop` are answered at info level with standing, walking or stopping."""
    _are_answered(run, lambda row: DOING[row.message.data], "INFO", where=_is_command)
    _requires_a_choice(run, "INFO")


@commands.check(4, after=subscribes_to_commands, guess={
    PRINTED: lambda run: run.prints,
    "In the else branch: self.get_logger().warning(...), with msg.data in its text.": lambda run: True,
})
def warns(run: Recording) -> None:
    """Any other word is answered with a warning that names the word."""
    _are_answered(run, lambda row: row.message.data, "WARN", where=lambda row: not _is_command(row))
    _requires_a_choice(run, "WARN", "INFO")


@commands.check(2, after=obeys)
def logs_nothing_else(run: Recording) -> None:
    """Each word gets its own answer and no other."""
    for row in run.messages(COMMAND):
        if line := _first_contradiction(run, row):
            answer = f"“{DOING[row.message.data]}”" if _is_command(row) else "a warning"
            expected = f"only {answer} after “{row.message.data}”"
            hint = "Compare whole words with ==, and use if, elif, else: then exactly one branch runs."
            raise Missed(expected, f"“{line.text}” ({line.level}) at {line.stamp:.3g} s", hint)


def _requires_a_choice(run: Recording, *levels: str) -> None:
    """Raise Missed where at each of these levels most commands get the answer of another one."""
    sent = list(filter(_is_command, run.messages(COMMAND)))
    for level in levels:
        wrong = [(row, line) for row in sent if (line := _first_contradiction(run, row, level))]
        if len(wrong) <= len(sent) / 2:
            return
    row, line = wrong[0]
    expected = f"only “{DOING[row.message.data]}” after “{row.message.data}”"
    hint = "Answering everything answers nothing. With if, elif, else exactly one branch runs."
    raise Missed(expected, f"“{line.text[:60]}” at {row.stamp:.3g} s", hint)


def _are_answered(run: Recording, pattern: Any, level: str, where: Any) -> None:
    answers(run, COMMAND, pattern, level=level, within=WITHIN, where=where)


def _is_command(row: Message) -> bool:
    return row.message.data in COMMANDS


def _first_contradiction(run: Recording, row: Message, level: str = "") -> LogLine | None:
    """The first line in response to a message, at a level, that another message should have had."""
    others = [doing for command, doing in DOING.items() if command != row.message.data]
    for line in Window.after(row.stamp, WITHIN).rows(run.logs):
        wrong = any(doing in line.text.lower() for doing in others)
        if level in ("", line.level) and (wrong if line.level == "INFO" else _is_command(row)):
            return line
    return None
