"""The attributes that callbacks read, write and test."""

import pytest
from rclpy.node import Node

from sim.notebook.attribute_analysis import attributes_of
from sim.notebook.class_source import methods_of


class Pairs(Node):
    limit = 3

    def __init__(self):
        super().__init__("pairs")
        self.last, self.seen, self.total = None, [], 0
        self.create_subscription(object, "/a", self.on_a, 10)
        self.create_subscription(object, "/b", self.on_b, 10)
        self.create_timer(1.0, self.tick)

    @property
    def mean(self):
        return self.total / len(self.seen)

    def on_a(self, msg):
        """Stores it.

        At any indent."""
        self.last = msg
        self.seen.append(msg)
        self.get_logger().info("received")

    def on_b(self, msg):
        self.total += self.last.data

    def tick(self):
        if self.enough():
            self.report(self.mean)

    def enough(self):
        return len(self.seen) > self.limit

    def report(self, mean):
        self.mean_then = mean


class Careful(Pairs):
    def on_b(self, msg):
        last = self.last
        if last is None:
            return
        self.total += last.data


class AsksFirst(Pairs):
    def on_b(self, msg):
        if hasattr(self, "last"):
            self.total += self.last.data


class Tries(Pairs):
    def on_b(self, msg):
        try:
            self.total += self.last.data
        except AttributeError:
            self.total = 0


class DefinesMore(Pairs):
    def on_b(self, msg):
        def done(future):
            self.total = self.last

        msg.add_done_callback(done)


class Extends(Pairs):
    def __init__(self):
        super().__init__()
        self.more = 0

    def on_a(self, msg):
        self.more += 1
        super().on_a(msg)

    def on_b(self, msg):
        return Pairs.on_b(self, msg)


def test_a_callback_has_what_its_methods_use():
    assert attributes_of(Pairs) == {
        "Pairs.on_a": ({"seen"}, {"last", "seen"}, set()),
        "Pairs.on_b": ({"last", "total"}, {"total"}, set()),
        "Pairs.tick": ({"limit", "seen", "total"}, {"mean_then"}, {"limit", "seen"}),
    }


@pytest.mark.parametrize("class_", [Careful, AsksFirst, Tries])
def test_what_is_tested_first_is_guarded(class_):
    uses = attributes_of(class_)[f"{class_.__name__}.on_b"]
    assert "last" in uses.guarded
    assert uses.writes == {"total"}


def test_a_function_that_is_only_defined_reads_later_and_counts_as_a_writer():
    uses = attributes_of(DefinesMore)["DefinesMore.on_b"]
    assert uses == (set(), {"total"}, set())


def test_a_call_of_the_overridden_method_counts_as_its_body():
    uses = attributes_of(Extends)
    assert list(uses) == ["Extends.on_a", "Extends.on_b", "Extends.tick"]
    assert uses["Extends.on_a"].writes == {"last", "more", "seen"}
    assert uses["Extends.on_b"] == attributes_of(Pairs)["Pairs.on_b"]


def test_lines_are_those_of_the_file():
    assert methods_of(Careful)["on_b"].lineno == Careful.on_b.__code__.co_firstlineno
    assert methods_of(Careful)["tick"].lineno == Pairs.tick.__code__.co_firstlineno


def test_a_class_without_source_has_no_callbacks():
    made = {}
    exec("class Made:\n    def go(self):\n        self.x = self.go\n", made)
    assert attributes_of(made["Made"]) == {}
