"""Takes from action servers and clients directly, because no wait set reports what is there."""

from __future__ import annotations

from typing import Any


def take_at_server(server: Any) -> dict[str, Any]:
    """At most one request of each kind, with its header."""
    server._is_goal_request_ready = server._is_cancel_request_ready = server._is_result_request_ready = True
    server._is_goal_expired = False
    return server.take_data()


def take_at_client(client: Any) -> dict[str, Any]:
    """At most one response, feedback or status of each kind."""
    client._is_goal_response_ready = client._is_cancel_response_ready = True
    client._is_result_response_ready = client._is_feedback_ready = client._is_status_ready = True
    return client.take_data()
