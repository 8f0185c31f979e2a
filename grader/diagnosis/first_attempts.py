"""Mistakes of a first node that raise no error: they explain why nothing, or little, was published."""

from __future__ import annotations

from sim.evidence import INFRASTRUCTURE_TOPICS, CallbackRun, Recording

KINDS = ("timer", "subscription")  # of callbacks that may publish, the likelier first
MAX_FIRES = 2  # a timer that fired no more often in a whole run may have the wrong period
MIN_PERIOD = 2.0  # s


def publish_not_reached(recording: Recording) -> str:
    """A node that never published anything, although its callbacks ran: `publish` is not reached."""
    used = {message.sender for message in recording.messages()}
    for end in recording.graph.publishers():
        if end.node in used or end.node in recording.course_nodes or end.name in INFRASTRUCTURE_TOPICS:
            continue
        runs = [run for run in recording.callbacks if run.node == end.node]
        ran = next(filter(None, ([run for run in runs if run.kind == kind] for kind in KINDS)), [])
        if ran:
            count = _times(ran, ran[0].callback)
            return (
                f"{end.node} has a publisher on {end.name}, but never publishes: {ran[0].callback} ran "
                f"{count}, and publish() was never reached. Look for an `if` that is never true, a `return` "
                "before it, or a method that is never called; a print in front of it shows which."
            )
    return ""


def long_period(recording: Recording) -> str:
    """A node's only timer, with a period of whole seconds, fired once or twice in the run."""
    for timer in recording.graph.timers:
        if timer.node in recording.course_nodes or timer.period < MIN_PERIOD or timer.period % 1.0:
            continue
        if sum(other.node == timer.node for other in recording.graph.timers) > 1:
            continue
        fired = [run for run in recording.callbacks if run.node == timer.node and run.kind == "timer"]
        due = int(recording.ended.stamp / timer.period + 1e-6)
        if 0 < len(fired) <= MAX_FIRES and len(fired) == due:
            name, tenth = fired[0].callback, timer.period / 10
            return (
                f"The timer of {timer.node} has a period of {timer.period:g} s: {name} ran "
                f"{_times(fired, name)} in {recording.ended.stamp:.3g} s. The period is 1 / rate, in "
                f"seconds: {tenth:g} s gives {1 / tenth:g} Hz."
            )
    return ""


def _times(runs: list[CallbackRun], callback: str) -> str:
    count = sum(run.callback == callback for run in runs)
    return "once" if count == 1 else f"{count} times"
