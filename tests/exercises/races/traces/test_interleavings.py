"""The model of the counting node agrees with the node itself: possible traces by runs, the others by search."""

import ast
import itertools
import time
from functools import partial
from pathlib import Path

import nbformat
import pytest
from rclpy.node import Node
from std_msgs.msg import String

from grader.exercises.races.traces.interleavings import EXECUTORS, STATEMENTS, is_possible
from grader.exercises.races.traces.listed import TRACES, possible_traces
from grader.exercises.races.traces.senders import senders
from sim import run

NOTEBOOK = Path("solutions/15_races/races.ipynb")


def cell(name):
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    return next(each.source for each in notebook.cells if each.id == name)


def programs(delays=None):
    """The programs of the notebook; with delays, a thread sleeps before a callback's statement.

    delays: s, by the message and the number of its callback's statement.
    """

    def wait(name, number):
        if (delays or {}).get((name, number)):
            time.sleep(delays[name, number])

    names = {"wait": wait}
    exec(cell("setup"), names)
    tree = ast.parse(cell("traces-node") + "\n\n" + cell("traces-executors"))
    for function in ast.walk(tree):
        if delays and isinstance(function, ast.FunctionDef) and function.name.startswith("on_"):
            waits = [ast.parse(f"wait(msg.data, {number})").body[0] for number in range(len(function.body))]
            function.body = [each for pair in zip(waits, function.body, strict=True) for each in pair]
    exec(compile(ast.fix_missing_locations(tree), str(NOTEBOOK), "exec"), names)
    return names


class TimedSender(Node):
    """Publishes each text on a topic at its own time, which stands for a message that is late."""

    def __init__(self, topic, times):
        super().__init__(f"{topic}_sender")
        self.publisher = self.create_publisher(String, f"/{topic}", 10)
        for text, seconds in times.items():
            self.create_timer(seconds, partial(self.send, text))
        self.sent = set()

    def send(self, text):
        if text not in self.sent:
            self.sent.add(text)
            self.publisher.publish(String(data=text))


def trace_of(executor, times, delays=None):
    """What the node publishes if its messages come at these times (s), and its threads wait."""
    by_topic = {"left": "AB", "right": "C", "report": ("report",)}
    senders = [partial(TimedSender, topic, {text: times.get(text, 1.0) for text in texts})
               for topic, texts in by_topic.items()]  # fmt: skip
    return lines_of(run(programs(delays)[executor], companions=senders, seconds=3, quiet=True))


def lines_of(recording):
    assert not recording.failure
    return tuple(row.message.data for row in recording.messages("/trace"))


# For each possible trace what leads to it, in s: when messages arrive, and waits before statements of callbacks.
WITNESSES = {
    1: ({"C": 1.1, "report": 1.2, "B": 1.3}, {}),
    2: ({"C": 1.0, "A": 1.1, "B": 1.2, "report": 1.3}, {}),
    3: ({"A": 1.0, "B": 1.0, "C": 1.5, "report": 1.6}, {("A", 0): 0.2}),
    4: ({"A": 1.0, "report": 1.1, "C": 1.5, "B": 1.6}, {("A", 2): 0.2}),
    5: ({"A": 1.0, "C": 1.1, "B": 1.6, "report": 1.7}, {("A", 2): 0.2, ("C", 2): 0.2}),
    6: ({"A": 1.0, "C": 1.1, "B": 1.6, "report": 1.7}, {("A", 2): 0.2, ("C", 1): 0.3}),
    8: ({"A": 1.0, "C": 1.1, "report": 1.2, "B": 1.3}, {("report", 1): 0.3}),
}


@pytest.mark.parametrize(
    ("executor", "number"),
    [(executor, number) for executor in EXECUTORS for number in sorted(possible_traces(executor))],
)
def test_a_possible_trace_happens(executor, number):
    assert trace_of(executor, *WITNESSES[number]) == TRACES[number]


@pytest.mark.parametrize("executor", EXECUTORS)
def test_no_order_shows_what_the_model_excludes(executor):
    program = programs()[executor]
    for order in [0, *(f"{level}{number}" for level in ("host-", "") for number in range(1, 13))]:
        lines = lines_of(run(program, companions=senders, seconds=1.5, quiet=True, order=order))
        assert is_possible(lines, executor), f"order {order}: {lines}"


@pytest.mark.soak
@pytest.mark.parametrize("executor", EXECUTORS)
def test_no_delays_show_what_the_model_excludes(executor):
    """Messages at all combinations of two times, and each statement in turn waits as long as that."""
    places = [(name, number) for name in STATEMENTS for number in range(len(STATEMENTS[name]))]
    for times in itertools.product((1.0, 1.1), repeat=4):
        arrivals = dict(zip(("A", "B", "C", "report"), times, strict=True))
        if arrivals["A"] > arrivals["B"]:
            continue  # one publisher's messages keep their order
        for place in places:
            lines = trace_of(executor, arrivals, {place: 0.15})
            assert is_possible(lines, executor), f"{arrivals}, {place} waits: {lines}"


def test_the_notebook_lists_these_traces():
    rows = [line.strip("| ").split(" | ") for line in cell("traces-list").splitlines() if " · " in line]
    assert {int(number): tuple(trace.split(" · ")) for number, trace in rows} == TRACES


def test_executors():
    assert possible_traces("single") < possible_traces("exclusive") < possible_traces("reentrant") < {*TRACES}
    with pytest.raises(ValueError, match="executor must be one of single, exclusive, reentrant; it is 'two'"):
        possible_traces("two")
