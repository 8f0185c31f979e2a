"""A whole main(): it starts ROS, spins a node, and cleans up when somebody presses Ctrl-C."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.nodes.after_main import AfterMain, trace_of
from grader.exercises.nodes.lines import lines_like
from sim.recording import Recording


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
    """Ctrl-C leads main() to its end, without a traceback."""
    trace = trace_of(recording)
    if trace is None:
        hint = "After Ctrl-C nothing may spin again: the try block stands around all of the spinning."
        raise Missed("main() at its end", f"main() still running at {recording.ended.stamp:g} s", hint)
    if trace.raised:
        hint = "See the error above."
        if trace.raised == "KeyboardInterrupt":
            hint = "After the try block comes `except KeyboardInterrupt:`, and there `pass` is enough."
        cleaned = not (trace.still_up and trace.nodes)
        saw = f"{trace.raised} came out of main()"
        raise Missed("main() at its end", saw, hint, credit=0.5 * cleaned)


@check(points=3, after=ends_quietly)
def says_engine_off(recording: Recording) -> None:
    """After Ctrl-C the node logs “Engine off”."""
    hint = "What has to be done at the end, whatever happens, stands in the finally block."
    lines = [line for line, _ in lines_like(recording, r"engine off", "Engine off", hint=hint)]
    last = max(line.stamp for line in recording.logs if line.text == "1")
    if lines[-1].stamp <= last:
        raise Missed(f"“Engine off” after Ctrl-C, at {last + 1:g} s", f"it at {lines[-1].stamp:.3g} s", hint)


@check(points=3, after=ends_quietly)
def destroys_the_node(recording: Recording) -> None:
    """The node is destroyed."""
    left = trace_of(recording).nodes
    if left:
        hint = "destroy_node() belongs into the finally block, where it is reached whatever happens."
        raise Missed("no node left after main()", f"{left} is still there", hint)


@check(points=2, after=ends_quietly)
def shuts_down(recording: Recording) -> None:
    """ROS is shut down."""
    if trace_of(recording).still_up:
        hint = "What rclpy.init() began, rclpy.shutdown() ends: last line of the finally block."
        raise Missed("rclpy.ok() to be False after main()", "it is still True", hint)


whole_main = Exercise(
    "whole_main",
    "A main() that cleans up",
    [counts_down, ends_quietly, says_engine_off, destroys_the_node, shuts_down],
    scenarios=[AfterMain(seconds=7)],
)
