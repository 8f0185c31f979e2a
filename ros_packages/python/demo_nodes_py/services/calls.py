"""What both clients of add_two_ints do: wait for the service, call it and log the response."""

from __future__ import annotations

from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.task import Future


def call_when_available(node: Node) -> Future:
    """Wait for the service, and send it 2 and 3."""
    client = node.create_client(AddTwoInts, "add_two_ints")
    while not client.wait_for_service(timeout_sec=1.0):
        print("service not available, waiting again...")
    return client.call_async(AddTwoInts.Request(a=2, b=3))


def log_response(node: Node, future: Future) -> None:
    """Log the sum, or the exception in its place."""
    if future.result() is not None:
        node.get_logger().info(f"Result of add_two_ints: {future.result().sum}")
    else:
        node.get_logger().error(f"Exception while calling service: {future.exception()!r}")
