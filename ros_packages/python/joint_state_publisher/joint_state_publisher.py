"""The program joint_state_publisher: publishes a position of each movable joint on /joint_states."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import rclpy
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.utilities import remove_ros_args
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from joint_state_publisher.description import JointTable, read_joints

PARAMETERS: tuple[tuple[str, Any, int], ...] = (
    ("publish_default_efforts", False, ParameterType.PARAMETER_BOOL),
    ("publish_default_positions", True, ParameterType.PARAMETER_BOOL),
    ("publish_default_velocities", False, ParameterType.PARAMETER_BOOL),
    ("rate", 10, ParameterType.PARAMETER_INTEGER),
    ("source_list", [], ParameterType.PARAMETER_STRING_ARRAY),
    ("use_mimic_tags", True, ParameterType.PARAMETER_BOOL),
    ("use_smallest_joint_limits", True, ParameterType.PARAMETER_BOOL),
    ("delta", 0.0, ParameterType.PARAMETER_DOUBLE),
)
DEPENDENCE = ("parent", "factor", "offset")
QUANTITIES = ("position", "velocity", "effort")
ENDLESS = "Found an infinite recursive mimic chain"


class JointStatePublisher(Node):
    """Publishes the joints of a description, at positions that parameters and other topics set."""

    def __init__(self, description_file: str | None) -> None:
        """description_file: a URDF, or None if it arrives on /robot_description."""
        super().__init__("joint_state_publisher", automatically_declare_parameters_from_overrides=True)
        for name, default, kind in PARAMETERS:
            self._declare(name, default, kind)
        self._joints, self._dependent = JointTable(), self._dependent_joints()
        if description_file is not None:
            self._configure(Path(description_file).read_text(encoding="utf-8"))
        else:
            self.get_logger().info(
                "Waiting for robot_description to be published on the robot_description topic..."
            )
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, "robot_description", self._on_description, latched)
        for source in self._value("source_list"):
            self.create_subscription(JointState, source, self._on_source, 10)
        self.pub = self.create_publisher(JointState, "joint_states", 10)
        self.timer = self.create_timer(1.0 / self._value("rate"), self._publish)

    def _declare(self, name: str, default: Any, kind: int) -> None:
        with contextlib.suppress(ParameterAlreadyDeclaredException):  # set when the program was started
            self.declare_parameter(name, default, ParameterDescriptor(type=kind))

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value

    def _dependent_joints(self) -> dict[str, dict[str, Any]]:
        """The parameters dependent_joints.JOINT.parent, factor and offset, by joint."""
        found: dict[str, dict[str, Any]] = {}
        for name, parameter in self.get_parameters_by_prefix("dependent_joints").items():
            joint, separator, key = name.partition(".")
            if not separator or "." in key:
                raise ValueError(f"Invalid dependent_joint name '{name}'")
            if key not in DEPENDENCE:
                allowed = ", ".join(f"'{each}'" for each in DEPENDENCE)
                raise ValueError(f"Invalid dependent_joint name '{key}' (allowed values are {allowed})")
            found.setdefault(joint, {})[key] = parameter.value
        if any("parent" not in each for each in found.values()):
            raise ValueError("All dependent_joints must at least have a parent")
        return found

    def _configure(self, description: str) -> None:
        zeros = {name: each.value for name, each in self.get_parameters_by_prefix("zeros").items()}
        joints = read_joints(
            description,
            zeros,
            use_mimic=self._value("use_mimic_tags"),
            use_smallest_limits=self._value("use_smallest_joint_limits"),
        )
        for name in self._dependent.keys() & set(joints.names):
            joints.free.pop(name, None)
            joints.dependent[name] = self._dependent[name]
        for joint in joints.free.values():
            if self._value("publish_default_positions"):
                joint["position"] = joint["zero"]
            if self._value("publish_default_velocities"):
                joint["velocity"] = 0.0
            if self._value("publish_default_efforts"):
                joint["effort"] = 0.0
        self._joints = joints

    def _on_description(self, message: String) -> None:
        try:
            self._configure(message.data)
        except ValueError as error:
            self.get_logger().warning(str(error))

    def _on_source(self, message: JointState) -> None:
        for quantity in QUANTITIES:
            for name, value in zip(message.name, getattr(message, quantity), strict=False):
                if name in self._joints.free:
                    self._joints.free[name][quantity] = value

    def _publish(self) -> None:
        message = JointState()
        message.header.stamp = self.get_clock().now().to_msg()
        delta = self._value("delta")
        if delta > 0:
            for joint in self._joints.free.values():
                _move(joint, delta)
        message.name = list(self._joints.names)
        values = [self._values(name) for name in message.name]
        for quantity in QUANTITIES:
            if any(quantity in each for each in values):
                setattr(message, quantity, [each.get(quantity, 0.0) for each in values])
        if message.name:
            self.pub.publish(message)

    def _values(self, name: str) -> dict[str, float]:
        """Return what is known of a joint: position, velocity and effort."""
        factor, offset, chain = 1.0, 0.0, [name]
        while name not in self._joints.free:
            dependence = self._joints.dependent[name]
            offset += factor * dependence.get("offset", 0.0)
            factor *= dependence.get("factor", 1.0)
            name = dependence["parent"]
            if name in chain:
                self.get_logger().error(f"{ENDLESS}: {[*chain, name]}")
                sys.exit(1)
            chain.append(name)
        known = self._joints.free[name]
        transforms: Mapping[str, tuple[float, float]] = {
            "position": (factor, offset),
            "velocity": (factor, 0.0),
            "effort": (1.0, 0.0),
        }
        return {
            quantity: float(known[quantity]) * by + plus
            for quantity, (by, plus) in transforms.items()
            if quantity in known
        }


def _move(joint: dict[str, Any], delta: float) -> None:
    """Move a joint by a step towards one of its limits, and back from there."""
    forward = joint.get("forward", True)
    joint["position"] += delta if forward else -delta
    if forward and joint["position"] > joint["max"]:
        joint["position"] = joint["min"] if joint["continuous"] else joint["max"]
        joint["forward"] = joint["continuous"]
    elif not forward and joint["position"] < joint["min"]:
        joint["position"], joint["forward"] = joint["min"], True


def main() -> None:
    """Publish until Ctrl-C."""
    rclpy.init()
    parser = argparse.ArgumentParser()
    parser.add_argument("description_file", help="Robot description file to use", nargs="?", default=None)
    options = parser.parse_args(remove_ros_args(sys.argv)[1:])
    try:
        rclpy.spin(JointStatePublisher(options.description_file))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
