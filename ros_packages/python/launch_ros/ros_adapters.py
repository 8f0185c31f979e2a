"""The node with which launch itself takes part in the ROS graph."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from launch.launch_context import LaunchContext

if TYPE_CHECKING:
    from rclpy.node import Node


class ROSAdapter:
    """A node in a context of its own, which a thread spins until `shutdown` is called."""

    def __init__(self, name: str) -> None:
        # Imported late: rclpy is slow to import, and few launch files need it.
        import rclpy
        from rclpy.executors import SingleThreadedExecutor

        self.ros_context = rclpy.Context()
        rclpy.init(args=[], context=self.ros_context)
        self.ros_node: Node = rclpy.create_node(name, context=self.ros_context)
        self.ros_executor = SingleThreadedExecutor(context=self.ros_context)
        self.ros_executor.add_node(self.ros_node)
        self._thread = threading.Thread(target=self.ros_executor.spin, name="launch_ros", daemon=True)
        self._thread.start()

    def shutdown(self) -> None:
        """Stop spinning, and remove the node from the graph."""
        self.ros_executor.shutdown()
        self._thread.join()
        self.ros_node.destroy_node()
        self.ros_context.try_shutdown()


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """The adapter of a launch context. It is created by the first call, and shut down when launch ends."""
    adapter = context.get_locals_as_dict().get("ros_adapter")
    if adapter is None:
        adapter = ROSAdapter(f"launch_ros_{context.process_starter.pid}")
        context.extend_globals({"ros_adapter": adapter})
        context.call_at_end(adapter.shutdown)
    return adapter


def get_ros_node(context: LaunchContext) -> Node:
    """The node of a launch context; see `get_ros_adapter`."""
    return get_ros_adapter(context).ros_node
