"""Nodes that do too little: callbacks that block, nodes that nobody spins, publishers that nobody uses."""

from __future__ import annotations

from sim.recording import INFRASTRUCTURE_TOPICS, CallbackRun, Recording


def slow_callback(recording: Recording) -> str:
    """A timer that fires less often than it should because a callback of its node holds everything up."""
    for timer in recording.graph.timers:
        if timer.period <= 0 or is_robot(recording, timer.node):
            continue
        due = int(recording.ended.stamp / timer.period + 1e-6)
        of_node = [run for run in recording.callbacks if run.node == timer.node]
        fired = sum(run.kind == "timer" and run.callback == timer.callback for run in of_node)
        slowest = max(of_node, key=lambda run: run.duration, default=None)
        if slowest and _holds_up(slowest, of_node, timer.period) and fired < 0.8 * due:
            return (
                f"The timer of {timer.node} fired {_times(fired)} in {recording.ended.stamp:.3g} s; "
                f"{due} were due. "
                f"Most likely {slowest.callback} waits (time.sleep, a long loop, a blocking service "
                "call) instead of "
                f"returning: it held the node for {slowest.duration:.3g} s. Let the timer do the waiting."
            )
    return ""


def _holds_up(slowest: CallbackRun, of_node: list[CallbackRun], period: float) -> bool:
    """Whether a callback keeps the others of its node waiting; one that awaits or has a thread does not."""
    end = slowest.stamp + slowest.duration
    return slowest.duration > period and not any(slowest.stamp < run.stamp < end - 1e-6 for run in of_node)


def never_spun(recording: Recording) -> str:
    """A node with timers, incoming messages or requests, none of whose callbacks ever ran."""
    if recording.ended.reason == "blocked":
        return ""  # what is blocked did begin
    active = {run.node for run in recording.callbacks}
    for node in recording.graph.nodes:
        if node in active or is_robot(recording, node):
            continue
        what = _waiting_work(recording, node)
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
    if any(heard.topic in listening for heard in recording.heard):
        return "a subscription with messages waiting"
    if any(call.service in served and not call.lost for call in recording.calls):
        return "a service with requests waiting"
    if any(goal.action in acting and not goal.lost for goal in recording.goals):
        return "an action with goals waiting"
    return "a subscription" if listening and finished else ""


def ended_early(recording: Recording) -> str:
    """A program that ran to its end before the run's time was over."""
    ended = recording.ended
    if ended.reason != "finished" or ended.stamp >= recording.seconds - 1e-6:
        return ""
    return (
        f"{ended.detail} The run goes on until t = {recording.seconds:.3g} s. "
        "A node lives as long as something keeps it spinning: rclpy.spin(node) returns only at shutdown."
    )


def unused_publisher(recording: Recording) -> str:
    """A publisher that never sent anything."""
    used = {(heard.sender, heard.topic) for heard in recording.heard}
    for end in recording.graph.publishers():
        if (end.node, end.name) in used or end.name in INFRASTRUCTURE_TOPICS or is_robot(recording, end.node):
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


def empty_node(recording: Recording) -> str:
    """A node that was created, and nothing in it."""
    busy = {
        e.node for e in recording.graph.endpoints if e.name not in INFRASTRUCTURE_TOPICS and "/" in e.name
    }
    busy |= {timer.node for timer in recording.graph.timers}
    # of the services that every node has, too, which are not in the graph
    busy |= {node for call in recording.calls for node in (call.client, call.server)}
    for node in recording.graph.nodes:
        if node not in busy:
            return f"{node} has no publisher, no subscription and no timer: nothing can happen in it."
    return ""


def is_robot(recording: Recording, node: str) -> bool:
    """Is this the simulated robot's node? What it does or leaves is never the student's mistake."""
    return recording.world is not None and node == "/robot"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"
