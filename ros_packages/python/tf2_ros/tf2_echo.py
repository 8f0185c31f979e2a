"""The program tf2_echo: prints the transform between two frames repeatedly."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time
from rclpy.utilities import remove_ros_args
from tf2_py import TransformException
from tf_transformations import euler_from_quaternion, quaternion_matrix

from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener

USAGE = """\
Usage: tf2_echo source_frame target_frame [echo_rate]

Prints the pose of target_frame in source_frame, echo_rate times a second (default: 1)."""
INVALID_RATE = 2  # exit status


def main() -> int:
    """Print until Ctrl-C; returns the exit status."""
    rclpy.init()
    try:
        arguments = remove_ros_args(sys.argv)[1:]
        if len(arguments) not in (2, 3):
            print(USAGE)
            return 1
        try:
            rate = float(arguments[2]) if arguments[2:] else 1.0
        except ValueError:
            text = f"Failed to convert rate argument '{arguments[2]}' to a floating-point number"
            print(text, file=sys.stderr)
            return INVALID_RATE
        node = _Echo(arguments[0], arguments[1])
        node.create_timer(1 / rate, node.echo)
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0


class _Echo(Node):
    def __init__(self, source: str, target: str) -> None:
        super().__init__("tf2_echo")
        self._frames, self._buffer, self._found = (source, target), Buffer(), False
        self._listener = TransformListener(self._buffer, self)

    def echo(self) -> None:
        """Print the latest transform, or why it is not available."""
        source, target = self._frames
        try:
            found = self._buffer.lookup_transform(source, target, Time())
        except TransformException as error:
            if self._found:
                print(f"Failure at {self.get_clock().now().nanoseconds / 1e9}\nException thrown:{error}")
                print(f"The current list of frames is:\n{self._buffer.all_frames_as_string()}", flush=True)
            else:
                self.get_logger().info(f"Waiting for transform {source} ->  {target}: {error}")
            return
        self._found = True
        print(_format(found), flush=True)


def _format(message: TransformStamped) -> str:
    stamp, transform = message.header.stamp, message.transform
    position = (transform.translation.x, transform.translation.y, transform.translation.z)
    quaternion = (transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w)
    angles = euler_from_quaternion(quaternion)
    matrix = quaternion_matrix(quaternion)
    matrix[:3, 3] = position
    return "\n".join(
        [
            f"At time {stamp.sec}.{stamp.nanosec}",
            f"- Translation: {_format_numbers(position)}",
            f"- Rotation: in Quaternion {_format_numbers(quaternion)}",
            f"- Rotation: in RPY (radian) {_format_numbers(angles)}",
            f"- Rotation: in RPY (degree) {_format_numbers(map(math.degrees, angles))}",
            "- Matrix:",
            *("".join(f" {_round(number):6.3f}" for number in row) for row in matrix),
        ]
    )


def _format_numbers(numbers: Iterable[float]) -> str:
    return "[" + ", ".join(f"{_round(number):.3f}" for number in numbers) + "]"


def _round(number: float) -> float:
    return round(number, 3) + 0.0  # 0 instead of -0


if __name__ == "__main__":
    sys.exit(main())
