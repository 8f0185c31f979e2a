"""Queries of the graph: another process's services are found, and none works after rclpy.shutdown()."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.contexts import require_context
from sim.ros.hooks.table import hook

# What rclpy writes when a query fails, and the queries.
QUERIES = {
    "Failed to get node names": (
        "get_node_names",
        "get_node_names_and_namespaces",
        "get_node_names_and_namespaces_with_enclaves",
    ),
    "failed to get topic names and types": ("get_topic_names_and_types",),
    "failed to get service names and types": (
        "get_service_names_and_types",
        "get_service_names_and_types_by_node",
    ),
    "failed to get publisher names and types": ("get_publisher_names_and_types_by_node",),
    "failed to get subscriber names and types": ("get_subscriber_names_and_types_by_node",),
    "failed to get client names and types": ("get_client_names_and_types_by_node",),
    "Error in rcl_count_publishers": ("count_publishers",),
    "Error in rcl_count_subscribers": ("count_subscribers",),
    "Error in rcl_count_clients": ("count_clients",),
    "Error in rcl_count_services": ("count_services",),
    "Failed to get information by topic for publishers": ("get_publishers_info_by_topic",),
    "Failed to get information by topic for subscriptions": ("get_subscriptions_info_by_topic",),
}
SEEKING = "get_service_names_and_types", "get_service_names_and_types_by_node", "count_services"


def _query(failed: str, name: str) -> None:
    @hook(Node, name, "no query works after rclpy.shutdown(), and other processes' services get proxies")
    def query(original: Callable) -> Callable:
        def query(self: Node, *arguments: Any, **keywords: Any) -> Any:
            run = engine()
            if run is not None:
                with self.handle:  # raises InvalidHandle if it was destroyed
                    require_context(self, failed)
                if name in SEEKING and run.transport.peer is not None:
                    run.transport.peer.seek()
            return original(self, *arguments, **keywords)

        return query


for _failed, _names in QUERIES.items():
    for _name in _names:
        _query(_failed, _name)
