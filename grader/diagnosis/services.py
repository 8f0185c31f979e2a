"""Calls of services that come to nothing: no server, no spinning, nothing in the response."""

from __future__ import annotations

import ast

from grader.diagnosis.bundled import bundled_nodes
from grader.diagnosis.student_nodes import student_nodes
from sim.evidence import CallbackRun, Recording, Seconds, is_node_service
from sim.notebook.class_source import Function

ROUNDING = 1e-6  # s: moments that are closer are the same
SPIN = "rclpy.spin(node), or rclpy.spin_until_future_complete(node, future)"


def not_offered(recording: Recording) -> str:
    """A call that no node can answer: no node offers it, or there is no node of that name."""
    bundled = bundled_nodes(recording)
    offers = (("client", "service", "service"), ("action client", "action server", "action"))
    asked = {(call.client, call.service) for call in recording.calls}
    asked |= {(goal.client, goal.action) for goal in recording.goals}
    active = {run.node for run in recording.callbacks}
    for client_kind, server_kind, what in offers:
        offered = {end.name for end in recording.graph.ends(server_kind)}
        for end in recording.graph.ends(client_kind):
            if end.node in bundled:
                continue
            waits = (end.node, end.name) in asked or end.node not in active | _gave_up(recording)
            if end.name not in offered and waits:
                return (
                    f"{end.node} has a client for the {what} {end.name}, but no node offers it. Is the "
                    "server running, and is the name right?"
                )
    for call in recording.calls:
        node, _, service = call.service.rpartition("/")
        if not call.server and is_node_service(call.service) and node not in recording.graph.nodes:
            nodes = ", ".join(recording.graph.nodes)
            return f"{call.client} calls {service} of the node {node}, but there are only {nodes}."
    return ""


def _gave_up(recording: Recording) -> set[str]:
    """Nodes that logged something, of programs that ended by themselves: they know what is missing."""
    if recording.ended.reason != "finished":
        return set()
    return {"/" + line.node.replace(".", "/") for line in recording.logs if line.stamp > 0.0}


def no_server(recording: Recording) -> str:
    """A request or goal that was sent before there was a server to take it, or before it was found."""
    lost = [(call.service, call.client, call.requested, "service") for call in recording.calls if call.lost]
    lost += [(goal.action, goal.client, goal.requested, "server") for goal in recording.goals if goal.lost]
    for name, client, asked, what in lost:
        servers = [e.node for e in recording.graph.endpoints if e.name == name and "client" not in e.kind]
        if servers:
            return (
                f"{client} called {name} at {asked:.3g} s, before it had found {servers[0]}: two programs "
                "need a moment to discover each other, and what is sent before that is lost. Wait first: "
                f"`while not client.wait_for_{what}(timeout_sec=1.0)`."
            )
    return ""


def response_not_received(recording: Recording) -> str:
    """A client whose answer came, but whose node didn't spin any more, or never did."""
    if recording.ended.reason == "blocked":
        return ""
    exchanges = [(c.service, c.client, c.requested, c.answered, c.received) for c in recording.calls]
    exchanges += [(g.action, g.client, g.requested, _decided(g.events), g.answered) for g in recording.goals]
    for name, client, asked, answered, received in exchanges:
        if asked is None or answered is None or received is not None or not client:
            continue
        if any(run.node == client and run.stamp + run.duration >= answered for run in recording.callbacks):
            continue  # it spins, and gave up waiting, or waits in a callback
        return (
            f"{client} called {name} at {asked:.3g} s, and the answer came at {answered:.3g} s, but {client} "
            f"never received it: answers come in while the node spins. Call {SPIN}."
        )
    return ""


def _decided(events: list[tuple[float, str]]) -> float | None:
    return events[0][0] if events else None


def response_dropped(recording: Recording) -> str:
    """An answer that came in, but that no done callback takes, and no callback awaited."""
    own = [run for run in recording.callbacks if run.kind != "client" and not _is_rclpys(run.callback)]
    took = {run.node for run in own if run.kind == "task"}
    for call in recording.calls:
        if call.received is None or call.requested is None or call.requested_by_course or call.client in took:
            continue
        asking = [run for run in own if run.node == call.client and _is_within(call.requested, run)]
        if asking and call.received > max(run.stamp + run.duration for run in asking) + ROUNDING:
            return (
                f"{call.client} called {call.service} at {call.requested:.3g} s, and the answer came at "
                f"{call.received:.3g} s, but no callback received it: "
                "`call_async(request).add_done_callback(self.on_response)` names the method that receives it."
            )
    return ""


def _is_within(stamp: Seconds, run: CallbackRun) -> bool:
    return run.stamp <= stamp <= run.stamp + run.duration + ROUNDING


def _is_rclpys(callback: str) -> bool:
    return callback.startswith(("Client.", "ActionClient."))


def empty_answers(recording: Recording) -> str:
    """A service of the student's all of whose answers are as empty as a new response."""
    calls = [call for call in recording.calls_of() if not call.served_by_course]
    answered = [call for call in calls if call.raw_response is not None]
    for service in dict.fromkeys(call.service for call in answered):
        responses = [call.response for call in answered if call.service == service]
        fields = list(responses[0].get_fields_and_field_types())
        empty = all(response == type(response)() for response in responses)
        if fields and empty and not _sets_a_field(recording, service):
            return (
                f"Every answer of {service} is empty: its callback never sets a field of the response. "
                f"Set them before you return it, as in `response.{fields[0]} = ...`."
            )
    return ""


def _sets_a_field(recording: Recording, service: str) -> bool:
    """Return whether the code of the service's callback, if it is known, sets a field or makes a response."""
    servers = {end.node for end in recording.graph.ends("service") if end.name == service}
    return any(
        _fills(method)
        for node in student_nodes(recording)
        if node.name in servers
        for callback, row in node.registered.items()
        if row.kind == "service" and row.topic and service.endswith(f"/{row.topic.strip('/')}")
        for method in node.parts(callback)
    )


def _fills(method: Function) -> bool:
    """Return whether it assigns an attribute of an argument, or passes values to a Response."""
    arguments = {argument.arg for argument in method.args.args[1:]}
    for part in ast.walk(method):
        if isinstance(part, ast.Call) and part.keywords and getattr(part.func, "attr", "") == "Response":
            return True
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Store):
            continue
        if isinstance(part.value, ast.Name) and part.value.id in arguments:
            return True
    return False
