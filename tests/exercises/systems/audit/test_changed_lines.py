"""The number of lines that a repair changes."""

import inspect

import pytest

from grader.exercises.systems.audit.changed_lines import changed_lines
from grader.exercises.systems.audit.six_systems import SYSTEMS


def methods_of(class_):
    return {name: inspect.getsource(part) for name, part in vars(class_).items() if inspect.isfunction(part)}


def test_a_copy_without_comments_and_annotations_changes_nothing():
    for name, parts in SYSTEMS.items():
        methods = methods_of(parts.node)
        assert changed_lines(name, methods, inherits=False) == 0
        plain = {each: source.replace(" -> None", "") for each, source in methods.items()}
        assert changed_lines(name, plain, inherits=False) == 0


def test_lines_that_are_added_removed_or_replaced_count_once_each():
    given = methods_of(SYSTEMS["dock"].node)
    assert changed_lines("dock", {**given, "on_departure": "def on_departure(self, msg):\n    self.take_next()"}, False) == 1
    assert changed_lines("dock", {"on_departure": "def on_departure(self, msg):\n    pass"}, True) == 2
    assert changed_lines("dock", {"more": "def more(self):\n    # why\n    return 1"}, True) == 2


def test_what_a_copy_leaves_out_counts_and_what_a_subclass_inherits_does_not():
    given = methods_of(SYSTEMS["dock"].node)
    without = {name: source for name, source in given.items() if name != "on_departure"}
    assert changed_lines("dock", without, inherits=False) == 3
    assert changed_lines("dock", {"admit": given["admit"]}, inherits=True) == 0


def test_a_call_of_the_overridden_method_does_not_count():
    source = "def on_point(self, msg):\n    super().on_point(msg)\n    self.send()"
    assert changed_lines("collector", {"on_point": source}, inherits=True) == 1


def test_what_is_no_method_cannot_be_read():
    for source in ("def (", "x = 1\ny = 2", 7.5):
        with pytest.raises(ValueError):
            changed_lines("dock", {"admit": source}, inherits=True)
