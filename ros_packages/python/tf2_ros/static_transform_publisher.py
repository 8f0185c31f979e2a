"""The program static_transform_publisher: publishes one static transform."""

from __future__ import annotations

import argparse
import hashlib
import sys

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from tf_transformations import quaternion_from_euler

from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster

TRANSLATION, ANGLES, QUATERNION = ("x", "y", "z"), ("roll", "pitch", "yaw"), ("qx", "qy", "qz", "qw")
# Positional arguments, deprecated upstream: their number, and the names of those before the two frames.
POSITIONAL = {8: (*TRANSLATION, "yaw", "pitch", "roll"), 9: (*TRANSLATION, *QUATERNION)}


def main() -> None:
    """Publish the transform of the command line until Ctrl-C."""
    rclpy.init()
    try:
        transform = _transform(remove_ros_args(sys.argv)[1:])
        frames = f"{transform.header.frame_id} {transform.child_frame_id}"
        # Upstream draws a random suffix; here equal runs have equal names.
        node = Node(f"static_transform_publisher_{hashlib.md5(frames.encode()).hexdigest()[:16]}")
        transform.header.stamp = node.get_clock().now().to_msg()
        broadcaster = StaticTransformBroadcaster(node)
        broadcaster.sendTransform(transform)
        node.get_logger().info(_format(transform))
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


def _transform(arguments: list[str]) -> TransformStamped:
    """The transform of the command line. Exits if it can't be parsed."""
    options = _parse(arguments)
    transform = TransformStamped(child_frame_id=options["child_frame_id"])
    transform.header.frame_id = options["frame_id"]
    translation, rotation = transform.transform.translation, transform.transform.rotation
    translation.x, translation.y, translation.z = (options[name] or 0.0 for name in TRANSLATION)
    if any(options[name] is not None for name in QUATERNION):
        rotation.x, rotation.y, rotation.z = (options[name] or 0.0 for name in QUATERNION[:3])
        rotation.w = 1.0 if options["qw"] is None else options["qw"]
    else:
        rotation.x, rotation.y, rotation.z, rotation.w = map(
            float, quaternion_from_euler(*(options[name] or 0.0 for name in ANGLES))
        )
    return transform


def _parse(arguments: list[str]) -> dict[str, object]:
    parser = argparse.ArgumentParser(
        "static_transform_publisher", description="Publish a static transform, in m and rad."
    )
    if len(arguments) in POSITIONAL and not any(argument.startswith("--") for argument in arguments):
        for name in POSITIONAL[len(arguments)]:
            parser.add_argument(name, type=float)
        parser.add_argument("frame_id")
        parser.add_argument("child_frame_id")
        unset = dict.fromkeys((*TRANSLATION, *ANGLES, *QUATERNION))
        return unset | vars(parser.parse_args(arguments))
    for name in (*TRANSLATION, *ANGLES, *QUATERNION):
        parser.add_argument(f"--{name}", type=float)
    parser.add_argument("--frame-id", required=True, help="the parent")
    parser.add_argument("--child-frame-id", required=True)
    options = vars(parser.parse_args(arguments))
    if all(any(options[name] is not None for name in names) for names in (QUATERNION, ANGLES)):
        parser.error("Cannot mix euler angles and quaternions")
    return options


def _format(transform: TransformStamped) -> str:
    translation, rotation = transform.transform.translation, transform.transform.rotation
    return (
        "Spinning until stopped - publishing transform\n"
        f"translation: ('{translation.x:f}', '{translation.y:f}', '{translation.z:f}')\n"
        f"rotation: ('{rotation.x:f}', '{rotation.y:f}', '{rotation.z:f}', '{rotation.w:f}')\n"
        f"from '{transform.header.frame_id}' to '{transform.child_frame_id}'"
    )


if __name__ == "__main__":
    main()
