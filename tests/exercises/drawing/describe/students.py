"""Descriptions of a camera that pans and tilts: right ones, and wrong ones named by their defect."""

import math
import tempfile
from functools import partial

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from robot_state_publisher.robot_state_publisher import RobotStatePublisher
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from tf_transformations import quaternion_from_euler

from sim import Process, executable

PARTS = ("described", "changed", "Broadcaster")

PAN = """
  <link name="base_link"/>
  <link name="pan_link"/>
  <joint name="pan_joint" type="revolute">
    <parent link="base_link"/>
    <child link="pan_link"/>
    <origin xyz="0 0 0.1"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="2" velocity="3"/>
  </joint>"""
LINKS = '<link name="tilt_link"/><link name="camera"/>'
TILT = """
  <joint name="tilt_joint" type="revolute">
    <parent link="pan_link"/>
    <child link="tilt_link"/>
    <origin xyz="0.05 0 0.06"/>
    <axis xyz="0 1 0"/>
    <limit lower="-0.5" upper="1.0" effort="2" velocity="3"/>
  </joint>"""
CAMERA = """
  <joint name="camera_joint" type="fixed">
    <parent link="tilt_link"/>
    <child link="camera"/>
    <origin xyz="0.04 0 0.02" rpy="3.1416 0 0"/>
  </joint>"""


def described(*parts):
    text = f'<robot name="pan_tilt">{"".join(parts)}</robot>'
    program = executable("robot_state_publisher", "robot_state_publisher")
    return Process(program, parameters={"robot_description": text})


def changed(old, new, text=TILT):
    """The description with a change in one of its joints."""
    assert old in text
    parts = (part.replace(old, new) if part == text else part for part in (TILT, CAMERA))
    return described(PAN, LINKS, *parts)


as_the_task_says = described(PAN, LINKS, TILT, CAMERA)
in_another_order = described(CAMERA, TILT, LINKS, PAN)
with_shapes = described(
    '<link name="tilt_link"><visual><geometry><box size="0.1 0.02 0.02"/></geometry></visual></link>'
    '<link name="camera"/><material name="blue"><color rgba="0 0 1 1"/></material>',
    *(PAN, TILT, CAMERA.replace("3.1416 0 0", "-3.14159 0 0")),
)


def from_a_file():
    """robot_state_publisher gets the description as a file."""
    with tempfile.NamedTemporaryFile("w", suffix=".urdf", encoding="utf-8") as file:
        file.write(f'<robot name="pan_tilt">{PAN}{LINKS}{TILT}{CAMERA}</robot>')
        file.flush()
        return RobotStatePublisher([file.name])


class Broadcaster(Node):
    """No robot_state_publisher: a node that publishes the description and broadcasts by itself."""

    def __init__(self):
        super().__init__("broadcaster")
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.description = self.create_publisher(String, "/robot_description", latched)
        self.description.publish(String(data=f'<robot name="a">{PAN}{LINKS}{TILT}{CAMERA}</robot>'))
        self.broadcaster, self.fixed = TransformBroadcaster(self), StaticTransformBroadcaster(self)
        now = self.get_clock().now().to_msg()
        camera = self.transform(now, "tilt_link", "camera", (0.04, 0.0, 0.02), (math.pi, 0, 0))
        self.fixed.sendTransform(camera)
        self.create_subscription(JointState, "/joint_states", self.on_state, 10)

    def on_state(self, msg):
        at = partial(self.transform, msg.header.stamp)
        now = dict(zip(msg.name, msg.position, strict=True))
        pan = at("base_link", "pan_link", (0.0, 0.0, 0.1), (0, 0, now["pan_joint"]))
        tilt = at("pan_link", "tilt_link", (0.05, 0.0, 0.06), (0, now["tilt_joint"], 0))
        self.broadcaster.sendTransform([pan, tilt])

    def transform(self, stamp, parent, child, place, turn):
        sent = TransformStamped(child_frame_id=child)
        sent.header.frame_id, sent.header.stamp = parent, stamp
        there, rotation = sent.transform.translation, sent.transform.rotation
        there.x, there.y, there.z = place
        rotation.x, rotation.y, rotation.z, rotation.w = quaternion_from_euler(*turn)
        return sent


def broadcasts_itself():
    """A design of its own: no robot_state_publisher, but a node that does its work for this robot."""
    rclpy.init()
    rclpy.spin(Broadcaster())


no_axis = changed('<axis xyz="0 1 0"/>', "")
axis_turned = changed("0 1 0", "0 -1 0")
centimeters = changed("0.05 0 0.06", "5 0 6")
no_origin = changed('<origin xyz="0.05 0 0.06"/>', "")
limits_in_degrees = changed('lower="-0.5" upper="1.0"', 'lower="-28.6" upper="57.3"')
no_effort = changed(' effort="2"', "")
no_velocity = changed(' velocity="3"', "")
other_effort = changed('effort="2"', 'effort="0"')
no_limit = changed('<limit lower="-0.5" upper="1.0" effort="2" velocity="3"/>', "")
turns_without_end = changed("revolute", "continuous")
other_joint_name = changed("tilt_joint", "tilt")
on_the_base = changed('<parent link="pan_link"/>', '<parent link="base_link"/>')
misspelt_link = changed('<parent link="pan_link"/>', '<parent link="pan_lnk"/>')
swapped_ends = changed(
    '<parent link="pan_link"/>\n    <child link="tilt_link"/>',
    '<parent link="tilt_link"/>\n    <child link="pan_link"/>',
)
camera_upright = changed(' rpy="3.1416 0 0"', "", CAMERA)
roll_in_degrees = changed("3.1416 0 0", "180 0 0", CAMERA)
camera_without_place = changed('xyz="0.04 0 0.02" ', "", CAMERA)
camera_turns = changed("fixed", "continuous", CAMERA)
not_closed = changed("</joint>", "")
without_camera = described(PAN, '<link name="tilt_link"/>', TILT)
only_the_pan = described(PAN)


LimitsOfNan = changed('lower="-0.5" upper="1.0"', 'lower="nan" upper="nan"')
LimitsInWords = changed('lower="-0.5"', 'lower="low"')
