"""Which wrong nodes of an exercise can go."""

from rclpy.node import Node

from tests.exercises import redundant as module
from tests.exercises.redundant import fewest, redundant, with_used, words
from tests.exercises.score_tables import students

TIMES = """{}: 7
- It does so once.
  Expected: one line
  Saw: {} lines
  Hint: __init__ runs once for each node: log the line there."""


class SaysItTwice(Node):
    lines = 2

    def __init__(self):
        super().__init__("hello")
        for _ in range(self.lines):
            self.get_logger().info("Hello, robot!")


class SaysItThreeTimes(SaysItTwice):
    lines = 3


class SaysItFourTimes(SaysItTwice):
    lines = 4


def test_what_two_nodes_show_differs_by_more_than_numbers_and_names():
    assert words(TIMES.format("A", 2)) == words(TIMES.format("B", 3)) != set()
    assert words(TIMES.format("A", "no")) != words(TIMES.format("A", 3))
    assert words("A: 10") == set()


def test_the_fewest_show_all_beside_those_that_are_kept():
    shows = {"a": {"1"}, "b": {"1", "2"}, "c": {"3"}, "d": {"2"}}
    assert fewest(shows, set()) == {"b", "c"}
    assert fewest(shows, {"a", "d"}) == {"a", "c", "d"}


def test_what_a_node_is_made_of_stays_with_it():
    source = "class A: pass\nclass B(A): pass\nclass C: x = K\nK = 1\nD = C\nclass E: pass"
    assert with_used({"B"}, source) == {"A", "B"}
    assert with_used({"D", "none"}, source) == {"C", "D", "K", "none"}


def test_a_node_stays_that_alone_finds_out_a_mutant(monkeypatch):
    """Only the one that says it twice finds out a check that lets two lines pass."""
    right = students("nodes", "hello")["Hello"]
    wrong = [SaysItFourTimes, SaysItTwice, SaysItThreeTimes]
    nodes = {node.__name__: node for node in [right, *wrong]}
    shown = {node.__name__: TIMES.format(node.__name__, node.lines) for node in wrong}
    monkeypatch.setattr(module, "students", lambda topic, name: nodes)
    monkeypatch.setattr(module, "page", lambda topic, name: {"Hello": "Hello: 10", **shown})
    assert redundant("nodes", "hello") == ["SaysItThreeTimes"]
