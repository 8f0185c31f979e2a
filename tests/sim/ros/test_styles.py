"""Whatever style a node is written in, it counts to three."""

import pytest

from sim import run
from tests.sim.ros.evidence import values
from tests.students.engine import styles

pytestmark = pytest.mark.pythons


@pytest.mark.parametrize(
    "program", styles.ALL, ids=lambda program: getattr(program, "__qualname__", "partial")
)
def test_every_style_counts_to_three(program):
    recording = run(program, seconds=3, quiet=True)
    assert values(recording, "/count") == [(0.5, 1), (1.0, 2), (1.5, 3)]
    assert (recording.errors, recording.stderr) == ([], "")


@pytest.mark.parametrize("program, name", [
    (styles.Middle, "Middle.tick"),
    (styles.Hierarchy, "Hierarchy.tick"),
    (styles.Partial, "Partial.tick"),
    (styles.CallableObject, "Tick"),
    (styles.Decorated, "Decorated.tick"),
    (styles.Coroutine, "Coroutine.tick"),
    (styles.closure, "tick"),
    (styles.class_in_function, "Local.tick"),
    (styles.Generator, "<lambda>"),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_a_callback_goes_by_the_name_its_author_knows(program, name):
    recording = run(program, seconds=1, quiet=True)
    assert {(callback.callback, callback.kind) for callback in recording.callbacks} == {(name, "timer")}
    assert [timer.callback for timer in recording.graph.timers] == [name]
