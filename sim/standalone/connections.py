"""Who is connected to whom around a robot in real time: its own nodes and those of other processes."""

from __future__ import annotations

from threading import Lock
from typing import Any

from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, Recording, is_node_service
from sim.ros2.live import ends_seen_by
from sim.ros2.system import is_hidden
from sim.view.graph_data import graph_data


class Connections:
    """Draws the graph of a `RealTimeRun` whenever a page asks for it, and anew only if it has changed."""

    def __init__(self, run: Any) -> None:
        self._run, self._lock = run, Lock()
        self._seen: list[Any] = []
        self._drawn: dict[str, Any] = {}

    def __call__(self) -> dict[str, Any]:
        """The graph as `graph_data` gives it. In any thread."""
        with self._lock:
            seen = [self._nodes(), self._ends()]
            if seen != self._seen:
                recording = Recording(course_nodes=self._course_nodes)
                recording.graph.nodes, recording.graph.endpoints = seen
                self._seen, self._drawn = seen, graph_data(recording, counted=False) or {}
            return self._drawn

    @property
    def _course_nodes(self) -> set[str]:
        return {node.get_fully_qualified_name() for node in self._run.nodes}

    def _nodes(self) -> list[str]:
        found = self._run.nodes[0].get_node_names_and_namespaces()
        return sorted(f"{space.rstrip('/')}/{name}" for name, space in found)

    def _ends(self) -> list[Endpoint]:
        course_nodes = self._course_nodes
        shown = [
            end._replace(from_course=end.node in course_nodes)
            for end in ends_seen_by(self._run.nodes[0])
            if end.name not in INFRASTRUCTURE_TOPICS and not is_node_service(end.name)
            if not is_hidden(end.name) and not is_hidden(end.node)
        ]
        return sorted(shown, key=repr)  # discovery has no order
