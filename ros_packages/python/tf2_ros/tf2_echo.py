"""The program that prints where one frame is in another, again and again: tf2_echo."""

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

Prints where target_frame is in source_frame, echo_rate times a second (default: 1)."""
NO_NUMBER = 2  # exit status


def main() -> int:
    """Print until Ctrl-C; the exit status."""
    rclpy.init()
    try:
        words = remove_ros_args(sys.argv)[1:]
        if len(words) not in (2, 3):
            print(USAGE)
            return 1
        try:
            rate = float(words[2]) if words[2:] else 1.0
        except ValueError:
            print(f"Failed to convert rate argument '{words[2]}' to a floating-point number", file=sys.stderr)
            return NO_NUMBER
        node = _Echo(words[0], words[1])
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
        """Print the newest transform, or what it waits for."""
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
        print(_shown(found), flush=True)


def _shown(found: TransformStamped) -> str:
    place, turn, stamp = found.transform.translation, found.transform.rotation, found.header.stamp
    quaternion = (turn.x, turn.y, turn.z, turn.w)
    angles = euler_from_quaternion(quaternion)
    matrix = quaternion_matrix(quaternion)
    matrix[:3, 3] = place.x, place.y, place.z
    return "\n".join(
        [
            f"At time {stamp.sec}.{stamp.nanosec}",
            f"- Translation: {_row((place.x, place.y, place.z))}",
            f"- Rotation: in Quaternion {_row(quaternion)}",
            f"- Rotation: in RPY (radian) {_row(angles)}",
            f"- Rotation: in RPY (degree) {_row(map(math.degrees, angles))}",
            "- Matrix:",
            *("".join(f" {_rounded(number):6.3f}" for number in row) for row in matrix),
        ]
    )


def _row(numbers: Iterable[float]) -> str:
    return "[" + ", ".join(f"{_rounded(number):.3f}" for number in numbers) + "]"


def _rounded(number: float) -> float:
    return round(number, 3) + 0.0  # not -0


if __name__ == "__main__":
    sys.exit(main())
