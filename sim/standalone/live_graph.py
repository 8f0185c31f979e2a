"""The graph of a robot in real time: its own nodes and those of other processes, by discovery."""

from __future__ import annotations

from threading import Lock
from typing import Any

from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, Recording, is_node_service
from sim.ros2.live import endpoints_seen_by
from sim.ros2.system import is_hidden
from sim.view.graph_data import graph_data


class LiveGraph:
    """Lays out the graph of a `RealTimeRun` on request, and again only if it has changed."""

    def __init__(self, run: Any) -> None:
        self._run, self._lock = run, Lock()
        self._state: tuple[list[str], list[Endpoint]] | None = None
        self._data: dict[str, Any] = {}

    def __call__(self) -> dict[str, Any]:
        """The graph as returned by `graph_data`. Thread-safe."""
        with self._lock:
            state = self._nodes(), self._ends()
            if state != self._state:
                recording = Recording(course_nodes=self._course_nodes)
                recording.graph.nodes, recording.graph.endpoints = state
                self._state, self._data = state, graph_data(recording, counted=False) or {}
            return self._data

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
            for end in endpoints_seen_by(self._run.nodes[0])
            if end.name not in INFRASTRUCTURE_TOPICS and not is_node_service(end.name)
            if not is_hidden(end.name) and not is_hidden(end.node)
        ]
        return sorted(shown, key=repr)  # discovery has no order
