"""Nodes that do too little: callbacks that block, nodes that don't spin, publishers that send nothing."""

from __future__ import annotations

import sys

from grader.diagnosis.parameters import OF_EVERY_NODE
from sim.evidence import (
    CALLS_PUBLISH,
    INFRASTRUCTURE_TOPICS,
    RATE,
    SPUN,
    UNFINISHED,
    WATCHES,
    CallbackRun,
    Recording,
)
from sim.notebook.run_programs import run_programs


def slow_callback(recording: Recording, canceled_early: int = 1) -> str:
    """A timer that fires less often than it should because a callback of its node holds everything up.

    canceled_early: up to so many times a timer fires that is canceled on purpose.
    """
    for timer in recording.graph.timers:
        if timer.period <= 0 or timer.node in recording.course_nodes:
            continue
        of_node = [run for run in recording.callbacks if run.node == timer.node]
        fires = [run for run in of_node if run.kind == "timer" and run.callback == timer.callback]
        fired, due = len(fires), int(recording.ended.stamp / timer.period + 1e-6)
        unfinished = any(row.node == timer.node and row.fact == UNFINISHED for row in recording.node_facts)
        busy = max(run.duration for run in of_node) if fires and unfinished else 0.0
        free = recording.ended.stamp - busy
        if fired <= canceled_early and _was_canceled(fires, of_node, timer.period, free):
            continue
        slowest = max(of_node, key=lambda run: run.duration, default=None)
        if slowest and _holds_up(slowest, of_node, timer.period) and fired < 0.8 * due:
            return (
                f"The timer of {timer.node} fired {_times(fired)} in {recording.ended.stamp:.3g} s; {due} "
                f"were due. Most likely {slowest.callback} waits (time.sleep, a long loop, a blocking "
                f"service call) instead of returning: it blocked the node for {slowest.duration:.3g} s. Let "
                "the timer do the waiting."
            )
    return ""


def certainly_slow_callback(recording: Recording) -> str:
    """The same, without timers that were canceled at any time, and were due no more."""
    return slow_callback(recording, sys.maxsize)


def _was_canceled(fires: list[CallbackRun], of_node: list[CallbackRun], period: float, end: float) -> bool:
    """Return whether a timer fired for the last time although its node was free for longer than its period.

    end: until when the recording has all that its node did.
    """
    if not fires:
        return False
    busy = sum(run.duration for run in of_node if run.stamp >= fires[-1].stamp)
    return end - fires[-1].stamp - busy > period + 1e-6


def _holds_up(slowest: CallbackRun, of_node: list[CallbackRun], period: float) -> bool:
    """Return whether a callback blocks the others of its node; one that awaits or has a thread does not."""
    end = slowest.stamp + slowest.duration
    return slowest.duration > period and not any(slowest.stamp < run.stamp < end - 1e-6 for run in of_node)


def busy_listener(recording: Recording) -> str:
    """A subscription that misses messages because its callbacks take too long."""
    for node in dict.fromkeys(end.node for end in recording.graph.subscriptions()):
        of_node = [run for run in recording.callbacks if run.node == node]
        taken = [run for run in of_node if run.kind == "subscription"]
        slowest = max(taken, key=lambda run: run.duration, default=None)
        if slowest is None or node in recording.course_nodes:
            continue
        topics = {end.name for end in recording.graph.subscriptions() if end.node == node}
        meant = [message for message in recording.published if message.topic in topics]
        sent = sum(message.stamp >= taken[0].stamp for message in meant)
        busy = sum(run.duration for run in of_node) / (recording.ended.stamp - taken[0].stamp or 1.0)
        if busy > 0.8 and len(taken) < 0.8 * sent and _holds_up(slowest, of_node, 0.0):
            return (
                f"{node} took {len(taken)} of {sent} messages: {slowest.callback} blocked it for up to "
                f"{slowest.duration:.3g} s each time, and more messages arrived meanwhile. A callback should "
                "store the message and return."
            )
    return ""


def never_spun(recording: Recording) -> str:
    """A node with timers, incoming messages or requests, none of whose callbacks ever ran."""
    if recording.ended.reason == "blocked":
        return ""  # what is blocked did begin
    active = {run.node for run in recording.callbacks} | {loop.node for loop in recording.busy_loops}
    active |= {row.node for row in recording.node_facts if row.fact == UNFINISHED}
    for node in recording.graph.nodes:
        if node in active or node in recording.course_nodes:
            continue
        what = _waiting_work(recording, node)
        if what == "a timer" and any(row.node == node and row.fact == RATE for row in recording.node_facts):
            return (
                f"{node} has a Rate, which is a timer of the node, but no other thread spins the node, so "
                "rate.sleep() never returns. Use create_timer in its place, or spin first in a thread: "
                "`threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()`."
            )
        if what:
            return (
                f"{node} has {what}, but none of its callbacks ever ran. "
                "Callbacks run while the node spins: call rclpy.spin(node) in main()."
            )
    return ""


def _waiting_work(recording: Recording, node: str) -> str:
    finished = recording.ended.reason == "finished"
    periods = [timer.period for timer in recording.graph.timers if timer.node == node]
    if periods and (finished or min(periods) <= recording.ended.stamp):
        return "a timer"
    listening = {e.name for e in recording.graph.subscriptions() if e.node == node} - INFRASTRUCTURE_TOPICS
    served = {end.name for end in recording.graph.ends("service") if end.node == node}
    acting = {end.name for end in recording.graph.ends("action server") if end.node == node}
    spun = any(row.node == node and row.fact == SPUN for row in recording.node_facts)
    if not spun and any(received.topic in listening for received in recording.published):
        return "a subscription with messages waiting"
    if any(call.service in served and not call.lost for call in recording.calls):
        return "a service with requests waiting"
    if any(goal.action in acting and not goal.lost for goal in recording.goals):
        return "an action with goals waiting"
    return "a subscription" if listening and finished and not spun else ""


def busy_loop(recording: Recording) -> str:
    """A loop without a pause: it works, for others of its program go on meanwhile, and fills a core."""
    if not recording.busy_loops:
        return ""
    loop = recording.busy_loops[0]
    return (
        f"From {loop.stamp:.3g} s on, a loop without a pause keeps a whole processor core busy: "
        f"{loop.place}. Move what it does into a timer's callback, or add time.sleep(0.01)."
    )


def ended_early(recording: Recording) -> str:
    """A program that ran to its end before the run's time was over."""
    ended = recording.ended
    if ended.reason != "finished" or ended.stamp >= recording.seconds - 1e-6:
        return ""
    return (
        f"{ended.detail} The run lasts until t = {recording.seconds:.3g} s. A node lives as long as "
        "something keeps it spinning: rclpy.spin(node) returns only at shutdown."
    )


def unused_publisher(recording: Recording) -> str:
    """A publisher that never sent anything, in code that doesn't call publish(), or calls it too rarely."""
    calling = {row.node for row in recording.node_facts if row.fact == CALLS_PUBLISH}
    early = {timer.node for timer in recording.graph.timers if timer.period <= recording.ended.stamp}
    timed = {timer.node for timer in recording.graph.timers} - early  # none of their timers fired
    return _silent_publisher(recording, calling - timed)


def quiet_publisher(recording: Recording) -> str:
    """A publisher that never sent anything, although there may have been nothing to send."""
    return _silent_publisher(recording, set())


def _silent_publisher(recording: Recording, excused: set[str]) -> str:
    used = {(received.sender, received.topic) for received in recording.published}
    for end in recording.graph.publishers():
        if (
            (end.node, end.name) in used
            or end.name in INFRASTRUCTURE_TOPICS
            or end.node in recording.course_nodes | excused
        ):
            continue
        what_next = _who_should_publish(recording, end.node)
        return f"{end.node} has a publisher on {end.name}, but never publishes. {what_next}"
    return ""


def _who_should_publish(recording: Recording, node: str) -> str:
    periods = [timer.period for timer in recording.graph.timers if timer.node == node]
    if periods and min(periods) > recording.ended.stamp:
        return (
            f"Its timer has a period of {min(periods):g} s, and the run lasts {recording.ended.stamp:.3g} s. "
            "The period is 1 / rate, in seconds."
        )
    if periods:
        return "Call publish(msg) on it in the timer's callback."
    if any(e.name not in INFRASTRUCTURE_TOPICS and e.node == node for e in recording.graph.subscriptions()):
        return "Call publish(msg) on it in the callback of the subscription."
    return "It has no timer either: self.create_timer(seconds, self.callback) calls a method again and again."


def _parameter_holders(recording: Recording) -> set[str]:
    """Nodes that declare parameters of their own, which other nodes may read and set."""
    return {
        row.node for row in recording.parameters if row.declared and not row.name.startswith(OF_EVERY_NODE)
    }


def empty_node(recording: Recording) -> str:
    """A node that was created, and nothing in it: it does not even log."""
    busy = {
        e.node for e in recording.graph.endpoints if e.name not in INFRASTRUCTURE_TOPICS and "/" in e.name
    }
    busy |= {timer.node for timer in recording.graph.timers}
    # of the services that every node has, too, which are not in the graph
    busy |= {node for call in recording.calls for node in (call.client, call.server)}
    busy |= {"/" + line.node.replace(".", "/") for line in recording.logs}
    busy |= {row.node for row in recording.node_facts if row.fact == WATCHES} | _parameter_holders(recording)
    if recording.ended.reason == "finished" or any(stamp > 0.0 for stamp, _ in recording.prints):
        return ""  # its program does something without the node's callbacks
    if len(run_programs(recording)) == 1 and busy & set(recording.graph.nodes) - recording.course_nodes:
        return ""  # it may hold the other nodes of its program
    for node in recording.graph.nodes:
        if node not in busy and node not in recording.course_nodes:
            return f"{node} has no publisher, no subscription and no timer: nothing can happen in it."
    return ""


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"
