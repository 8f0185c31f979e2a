"""The program add_two_ints_client_async: calls the service once, and spins step by step."""

from __future__ import annotations

from collections.abc import Sequence

import rclpy

from demo_nodes_py.services.calls import call_when_available, log_response


def main(args: Sequence[str] | None = None) -> None:
    """Call the service and log the sum."""
    rclpy.init(args=args)
    node = rclpy.create_node("add_two_ints_client")
    future = call_when_available(node)
    while rclpy.ok():
        rclpy.spin_once(node)
        if future.done():
            log_response(node, future)
            break
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
