"""The program add_two_ints_server: offers the service add_two_ints."""

from __future__ import annotations

from collections.abc import Sequence

from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

from demo_nodes_py.programs import spin_node


class AddTwoIntsServer(Node):
    """Adds two integers on request."""

    def __init__(self) -> None:
        super().__init__("add_two_ints_server")
        self.srv = self.create_service(AddTwoInts, "add_two_ints", self.add_two_ints_callback)

    def add_two_ints_callback(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        """Return the sum."""
        response.sum = request.a + request.b
        self.get_logger().info(f"Incoming request\na: {request.a} b: {request.b}")
        return response


def main(args: Sequence[str] | None = None) -> None:
    """Offer the service until Ctrl-C."""
    spin_node(AddTwoIntsServer, args)


if __name__ == "__main__":
    main()
