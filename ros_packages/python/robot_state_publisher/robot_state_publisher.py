"""The program robot_state_publisher: joint positions in, transforms out."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

import rclpy
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.time import Time
from rclpy.utilities import remove_ros_args
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from robot_state_publisher.model import InvalidDescription, Joint, parse_urdf

MAX_FREQUENCY = 1000.0  # Hz
NOT_INITIALIZED = "Unable to initialize urdf::model from robot description"
FROM_A_FILE = (
    "No robot_description parameter, but command-line argument available.  Assuming argument is name of "
    "URDF file.  This backwards compatibility fallback will be removed in the future."
)


class RobotStatePublisher(Node):
    """Publishes the transforms of fixed joints once, and of others when their positions arrive."""

    def __init__(self, arguments: list[str]) -> None:
        """arguments: the first is a URDF file, if there is no parameter robot_description."""
        super().__init__("robot_state_publisher")
        urdf = self.declare_parameter("robot_description", "").value or self._read_file(arguments)
        frequency = self.declare_parameter("publish_frequency", 20.0).value
        if not 0.0 <= frequency <= MAX_FREQUENCY:
            raise RuntimeError("publish_frequency must be between 0 and 1000")
        self.declare_parameter("frame_prefix", "")
        self.declare_parameter("ignore_timestamp", False)
        self._moving = TransformBroadcaster(self)
        self._static = StaticTransformBroadcaster(self)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._description = self.create_publisher(String, "robot_description", latched)
        self._joints: dict[str, Joint] = {}
        self._published: dict[str, int] = {}  # nanoseconds of each joint's last transform
        self._last_call = 0  # nanoseconds
        self._set_up(urdf)
        self.create_subscription(
            JointState,
            "joint_states",
            self._on_joint_state,
            qos_profile_sensor_data,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        self._publish_fixed()
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._on_parameters)

    def _read_file(self, arguments: list[str]) -> str:
        try:
            if not arguments:
                raise RuntimeError("robot_description parameter must not be empty")
            self.get_logger().warning(FROM_A_FILE)
            try:
                urdf = Path(arguments[0]).read_text(encoding="utf-8")
            except OSError as error:
                text = f"Failed to open URDF file: {arguments[0]}: {error.strerror}"
                raise RuntimeError(text) from None
        except RuntimeError as error:
            self.get_logger().fatal(str(error))
            raise
        self.set_parameters([Parameter("robot_description", value=urdf)])
        return urdf

    def _parse(self, urdf: str) -> dict[str, Joint]:
        try:
            return parse_urdf(urdf)
        except InvalidDescription as error:
            self.get_logger().error(str(error))
            raise RuntimeError(NOT_INITIALIZED) from None

    def _set_up(self, urdf: str) -> None:
        self._joints = dict(sorted(self._parse(urdf).items()))
        self._description.publish(String(data=urdf))
        self.get_logger().info("Robot initialized")

    def _publish_fixed(self) -> None:
        now = self.get_clock().now().to_msg()
        fixed = [joint for joint in self._joints.values() if not joint.moves and joint.type != "floating"]
        self._static.sendTransform([self._stamped(joint, 0.0, now) for joint in fixed])

    def _stamped(self, joint: Joint, position: float, stamp: TimeMessage) -> TransformStamped:
        prefix = self.get_parameter("frame_prefix").value
        message = TransformStamped(transform=joint.transform(position))
        message.header.stamp = stamp
        message.header.frame_id, message.child_frame_id = prefix + joint.parent, prefix + joint.child
        return message

    def _on_joint_state(self, state: JointState) -> None:
        if len(state.name) != len(state.position):
            if not state.position:
                self.get_logger().warning(
                    "Robot state publisher ignored a JointState message about joint(s) "
                    f'"{state.name[0]}"(,...) whose position member was empty.'
                )
            else:
                self.get_logger().error("Robot state publisher ignored an invalid JointState message")
            return
        now = self.get_clock().now().nanoseconds
        if self._last_call > now:  # a bag is played again, for example
            self.get_logger().warning("Moved backwards in time, re-publishing joint transforms!")
            self._published.clear()
        self._last_call = now
        stamp = Time.from_msg(state.header.stamp).nanoseconds
        if self.get_parameter("ignore_timestamp").value or stamp >= self._next_due(state.name, now):
            self._publish_moving(dict(zip(state.name, state.position, strict=True)), state.header.stamp)
            self._published.update(dict.fromkeys(state.name, stamp))

    def _next_due(self, names: list[str], now: int) -> float:
        """Return when the joint whose transform is the oldest is due, in nanoseconds."""
        frequency = self.get_parameter("publish_frequency").value
        oldest = min([now, *(self._published.get(name, 0) for name in names)])
        return oldest + int(1000.0 / frequency) * 1_000_000 if frequency else float("inf")

    def _publish_moving(self, positions: Mapping[str, float], stamp: TimeMessage) -> None:
        mimicked = {
            joint.name: positions[joint.mimic.joint] * joint.mimic.multiplier + joint.mimic.offset
            for joint in self._joints.values()
            if joint.mimic is not None and joint.mimic.joint in positions
        }
        known = {**mimicked, **positions}
        self._moving.sendTransform(
            [
                self._stamped(joint, known[joint.name], stamp)
                for joint in self._joints.values()
                if joint.moves and joint.name in known
            ]
        )

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            reason = ""
            if parameter.name == "robot_description":
                reason = self._why_invalid(parameter.value)
            elif parameter.name == "publish_frequency" and not 0.0 <= parameter.value <= MAX_FREQUENCY:
                reason = "publish_frequency must be between 0.0 and 1000.0"
            if reason:
                return SetParametersResult(successful=False, reason=reason)
        return SetParametersResult(successful=True)

    def _why_invalid(self, urdf: str) -> str:
        if not urdf:
            return "Empty URDF is not allowed"
        try:
            self._parse(urdf)
        except RuntimeError as error:
            self.get_logger().warning(str(error))
            return str(error)
        return ""

    def _on_parameters(self, parameters: list[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == "robot_description":
                self._set_up(parameter.value)
                self._publish_fixed()


def main() -> None:
    """Publish until Ctrl-C."""
    rclpy.init()
    try:
        rclpy.spin(RobotStatePublisher(remove_ros_args(sys.argv)[1:]))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
