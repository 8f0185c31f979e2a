"""Programs of ROS packages that the course includes: what they do is not the student's mistake."""

from __future__ import annotations

from dataclasses import replace

from sim.evidence import BUNDLED, Call, Goal, Graph, Recording


def bundled_nodes(recording: Recording) -> set[str]:
    """Full names of the nodes of included programs, such as turtlesim's mimic, and of `ros2` commands."""
    return {row.node for row in recording.node_facts if row.fact == BUNDLED}


def as_course_programs(recording: Recording) -> Recording:
    """The same run with the nodes of included programs counted among the course's nodes.

    Calls and goals between two of them are left out.
    """
    bundled = bundled_nodes(recording)
    if not bundled:
        return recording
    graph = recording.graph
    endpoints = [end._replace(from_course=end.from_course or end.node in bundled) for end in graph.endpoints]

    def concerns_students(exchange: Call | Goal) -> bool:
        return not {exchange.client, exchange.server or exchange.client} <= bundled

    return replace(
        recording,
        course_nodes=recording.course_nodes | bundled,
        graph=Graph(graph.nodes, endpoints, graph.timers),
        published=[
            row._replace(from_course=row.from_course or row.sender in bundled) for row in recording.published
        ],
        calls=list(filter(concerns_students, recording.calls)),
        goals=list(filter(concerns_students, recording.goals)),
    )
