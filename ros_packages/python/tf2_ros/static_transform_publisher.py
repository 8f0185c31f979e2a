"""The program that tells where one frame is that never moves: static_transform_publisher."""

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

PLACE, ANGLES, QUATERNION = ("x", "y", "z"), ("roll", "pitch", "yaw"), ("qx", "qy", "qz", "qw")
# Without options: how many words there are, and what those before both frames mean.
OLD = {8: (*PLACE, "yaw", "pitch", "roll"), 9: (*PLACE, *QUATERNION)}


def main() -> None:
    """Publish the transform of the command line until Ctrl-C."""
    rclpy.init()
    try:
        transform = _transform(remove_ros_args(sys.argv)[1:])
        frames = f"{transform.header.frame_id} {transform.child_frame_id}"
        # Upstream draws the end of the name; here equal runs shall have equal names.
        node = Node(f"static_transform_publisher_{hashlib.md5(frames.encode()).hexdigest()[:16]}")
        transform.header.stamp = node.get_clock().now().to_msg()
        broadcaster = StaticTransformBroadcaster(node)
        broadcaster.sendTransform(transform)
        node.get_logger().info(_told(transform))
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


def _transform(words: list[str]) -> TransformStamped:
    """What the words say. Ends the program where they can't be read."""
    asked = _options(words)
    transform = TransformStamped(child_frame_id=asked["child_frame_id"])
    transform.header.frame_id = asked["frame_id"]
    place, turn = transform.transform.translation, transform.transform.rotation
    place.x, place.y, place.z = (asked[name] or 0.0 for name in PLACE)
    if any(asked[name] is not None for name in QUATERNION):
        turn.x, turn.y, turn.z = (asked[name] or 0.0 for name in QUATERNION[:3])
        turn.w = 1.0 if asked["qw"] is None else asked["qw"]
    else:
        turn.x, turn.y, turn.z, turn.w = map(
            float, quaternion_from_euler(*(asked[name] or 0.0 for name in ANGLES))
        )
    return transform


def _options(words: list[str]) -> dict[str, object]:
    parser = argparse.ArgumentParser(
        "static_transform_publisher", description="Tell where a frame is that never moves, in m and rad."
    )
    if len(words) in OLD and not any(word.startswith("--") for word in words):
        for name in OLD[len(words)]:
            parser.add_argument(name, type=float)
        parser.add_argument("frame_id")
        parser.add_argument("child_frame_id")
        nothing = dict.fromkeys((*PLACE, *ANGLES, *QUATERNION))
        return nothing | vars(parser.parse_args(words))
    for name in (*PLACE, *ANGLES, *QUATERNION):
        parser.add_argument(f"--{name}", type=float)
    parser.add_argument("--frame-id", required=True, help="the parent")
    parser.add_argument("--child-frame-id", required=True)
    asked = vars(parser.parse_args(words))
    if all(any(asked[name] is not None for name in names) for names in (QUATERNION, ANGLES)):
        parser.error("Cannot mix euler angles and quaternions")
    return asked


def _told(transform: TransformStamped) -> str:
    place, turn = transform.transform.translation, transform.transform.rotation
    return (
        "Spinning until stopped - publishing transform\n"
        f"translation: ('{place.x:f}', '{place.y:f}', '{place.z:f}')\n"
        f"rotation: ('{turn.x:f}', '{turn.y:f}', '{turn.z:f}', '{turn.w:f}')\n"
        f"from '{transform.header.frame_id}' to '{transform.child_frame_id}'"
    )


if __name__ == "__main__":
    main()
