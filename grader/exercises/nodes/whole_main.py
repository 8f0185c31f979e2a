"""A whole main(): it starts ROS, spins a node, and cleans up on Ctrl-C."""

import re

from grader.checks import Missed, hinting, logs
from grader.companions.main_observer import Trace, observed, trace_of
from grader.exercise import Exercise, Scenario
from sim.evidence import Recording, Seconds

whole_main = Exercise("whole_main", "A main() that cleans up",
                      scenarios=[Scenario(seconds=7, prepare=observed)], may_end=True)


@whole_main.check(3)
def counts_down(run: Recording) -> Seconds:
    """main() creates the node and spins it: 3, 2, 1."""
    lines = [line for line in run.logs if re.fullmatch(r"\W*\d", line.text)]
    found, expected = [line.text for line in lines], "the lines 3, 2, 1"
    if not found:
        raise Missed(expected, "none of them", "Callbacks run while the node spins: rclpy.spin(node).")
    if found != ["3", "2", "1"]:
        raise Missed(expected, ", ".join(found), "Create one node, and spin it until Ctrl-C.")
    return lines[-1].stamp


@whole_main.check(4, after=counts_down)
def ends_quietly(run: Recording) -> Trace:
    """Ctrl-C ends main(), without a traceback."""
    trace = trace_of(run)
    if trace is None:
        hint = "After Ctrl-C nothing may spin again: put all of the spinning inside the try block."
        raise Missed("main() to return", f"main() still running at {run.ended.stamp:g} s", hint)
    if trace.raised:
        hint = "See the error above."
        if trace.raised == "KeyboardInterrupt":
            hint = "Follow the try block with `except KeyboardInterrupt:`; a `pass` in it is enough."
        cleaned = not (trace.still_up and trace.nodes)
        saw = f"{trace.raised} came out of main()"
        raise Missed("main() to return", saw, hint, credit=0.5 * cleaned, measured=trace)
    return trace


@whole_main.check(3, after=(ends_quietly, counts_down))
def logs_engine_off(run: Recording, trace: Trace, counted: Seconds) -> None:
    """After Ctrl-C the node logs “Engine off”."""
    with hinting("Anything that must happen at the end, even after an error, belongs in the finally block."):
        last = logs(run, r"^\W*?engine off", example="Engine off")[-1].stamp
        if last <= counted:
            raise Missed(f"“Engine off” after Ctrl-C, at {counted + 1:g} s", f"it at {last:.3g} s")


@whole_main.check(3, after=ends_quietly)
def destroys_the_node(run: Recording, trace: Trace) -> None:
    """The node is destroyed."""
    if trace.nodes:
        hint = "destroy_node() belongs in the finally block, which always runs."
        raise Missed("no node left after main()", f"{trace.nodes} is still there", hint)


@whole_main.check(2, after=ends_quietly)
def shuts_down(run: Recording, trace: Trace) -> None:
    """ROS is shut down."""
    if trace.still_up:
        hint = "rclpy.init() needs its rclpy.try_shutdown(): make it the last line of the finally block."
        raise Missed("rclpy.ok() to be False after main()", "it is still True", hint)
