"""A whole main(): it starts ROS, spins a node, and cleans up when somebody presses Ctrl-C."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.nodes.after_main import AfterMain, Trace, trace_of
from grader.exercises.nodes.lines import lines_like
from sim.recording import Recording


def _trace(recording: Recording) -> Trace:
    """What main() left behind. Raises Missed when main() never ended."""
    trace = trace_of(recording)
    if trace is None:
        hint = "Spin in a try block and let nothing start it again: after Ctrl-C, main() goes on to its end."
        raise Missed("main() at its end after Ctrl-C", f"main() still running at {recording.stamp:g} s", hint)
    return trace


@check(points=3)
def counts_down(recording: Recording) -> None:
    """main() makes the node and lets it work: 3, 2, 1."""
    hint = "Callbacks run while the node spins: rclpy.spin(node)."
    try:
        found = [line.text for line, _ in lines_like(recording, r"\d$", "3")]
    except Missed as missed:
        raise Missed("the lines 3, 2, 1", "none of them", hint) from missed
    if found != ["3", "2", "1"]:
        raise Missed("the lines 3, 2, 1", ", ".join(found), "Make one node, and spin until Ctrl-C ends it.")


@check(points=4, after=counts_down)
def ends_quietly(recording: Recording) -> None:
    """Ctrl-C ends main() without a traceback."""
    if _trace(recording).interrupted:
        hint = "After the try block comes `except KeyboardInterrupt:`, and there `pass` is enough."
        raise Missed("main() to catch KeyboardInterrupt", "KeyboardInterrupt came out of main()", hint)


@check(points=3, after=counts_down)
def says_engine_off(recording: Recording) -> None:
    """After Ctrl-C the node logs “Engine off”."""
    lines = [line for line, _ in lines_like(recording, r"engine off", "Engine off")]
    last = max(line.stamp for line in recording.logs if line.text == "1")
    if lines[0].stamp <= last:
        hint = "What has to be done at the end stands in the finally block."
        raise Missed(f"“Engine off” after Ctrl-C, at {last + 1:g} s", f"it at {lines[0].stamp:.3g} s", hint)


@check(points=3, after=counts_down)
def destroys_the_node(recording: Recording) -> None:
    """The node is destroyed."""
    left = _trace(recording).nodes
    if left:
        hint = "destroy_node() belongs into the finally block, where it is reached whatever happens."
        raise Missed("no node left after main()", f"{left} is still there", hint)


@check(points=2, after=counts_down)
def shuts_down(recording: Recording) -> None:
    """ROS is shut down."""
    if _trace(recording).still_up:
        hint = "What rclpy.init() began, rclpy.shutdown() ends: last line of the finally block."
        raise Missed("rclpy.ok() False after main()", "it is still True", hint)


whole_main = Exercise(
    "whole_main",
    "A main() that cleans up",
    [counts_down, ends_quietly, says_engine_off, destroys_the_node, shuts_down],
    scenarios=[AfterMain(seconds=7)],
)
