"""A node that says hello, and a node that counts."""

from __future__ import annotations

from grader.checks import Missed, check, named
from grader.exercise import Exercise
from grader.exercises.nodes.lines import Found, come_every, in_words, lines_like
from sim.recording import Recording


@check(points=7)
def says_hello(recording: Recording) -> None:
    """The node logs “Hello, robot!” at info level."""
    try:
        lines_like(recording, r"Hello, robot!", "Hello, robot!", level="INFO")
    except Missed as missed:
        if recording.logs or recording.prints:
            raise
        hint = "Debug lines are hidden, so use info; and a method that nobody calls says nothing."
        raise Missed(missed.expected, missed.saw, hint) from None


@check(points=3, after=says_hello)
def says_it_once(recording: Recording) -> None:
    """It says so once."""
    count = len(lines_like(recording, r"Hello, robot!", "Hello, robot!"))
    if count > 1:
        raise Missed("one line", f"{count} lines", "__init__ runs once for each node: there is the place.")


hello = Exercise("hello", "A node that says hello", [says_hello, says_it_once], seconds=3)


@check(points=3)
def called_counter(recording: Recording) -> None:
    """The node is called counter."""
    named(recording, "/counter")


def _counts(recording: Recording) -> list[Found]:
    return lines_like(recording, r"count\W+(\d+)", "Count: 1", level="INFO")


@check(points=5)
def logs_counts(recording: Recording) -> None:
    """The node logs lines like “Count: 1” at info level."""
    _counts(recording)


@check(points=6, after=logs_counts)
def counts_up(recording: Recording) -> None:
    """The count begins at 1 and goes up by 1 from line to line."""
    counts = [int(found[1]) for _, found in _counts(recording)]
    wanted = list(range(1, len(counts) + 1))
    if counts == wanted:
        return
    hint = "How much is added to the count, and how often?"
    if len(counts) > 1 and len(set(counts)) == 1:
        hint = "A variable of a method is gone when it returns: keep the count in self, from __init__ on."
    elif counts[0] == 0:
        hint = "The first count is 1: add before you log."
    raise Missed(in_words(wanted), in_words(counts), hint)


@check(points=6, after=logs_counts)
def counts_every_half_second(recording: Recording) -> None:
    """A count comes every 0.5 s."""
    come_every(recording, [line for line, _ in _counts(recording)], 0.5)


counter = Exercise(
    "counter",
    "A node that counts",
    [called_counter, logs_counts, counts_up, counts_every_half_second],
    seconds=4,
)
