"""ROS 2 programs that share a domain with the robot and know nothing of it: python clients.py NAME

Some end once they have seen what they wait for, and print it as JSON. The others print a line when they have
begun, and continue until they get a signal.
"""

import itertools
import json
import math
import sys
import time

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.parameter_client import AsyncParameterClient
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Float64, String


def node_of(name):
    rclpy.init()
    return Node(name)


def continue_for_ever(node, each=lambda: None):
    """Say that it has begun, and go on until it has to end."""
    each()
    print("here", flush=True)
    while True:
        rclpy.spin_once(node, timeout_sec=0.05)
        each()


def listen():
    """Wait for three scans and an odometry message that are newer than this program; print the last ones."""
    node, scans, odoms = node_of("listener"), [], []
    begin = node.get_clock().now()

    def keep(kept, message):
        if Time.from_msg(message.header.stamp) > begin:
            kept.append(message)

    node.create_subscription(LaserScan, "scan", lambda message: keep(scans, message), 10)
    node.create_subscription(Odometry, "odom", lambda message: keep(odoms, message), 10)
    while len(scans) < 3 or not odoms:
        rclpy.spin_once(node)
    x, v = odoms[-1].pose.pose.position.x, odoms[-1].twist.twist.linear.x
    print(json.dumps({"frame": scans[-1].header.frame_id, "x": x, "v": v}))


def parameters():
    """Ask the robot for the names of its parameters, as `ros2 param list` does."""
    node = node_of("curious")
    client = AsyncParameterClient(node, "robot")
    client.wait_for_services()
    future = client.list_parameters()
    rclpy.spin_until_future_complete(node, future)
    print(json.dumps(future.result().result.names))


def command(v, w, period, kind=Twist):
    node = node_of("commander")
    publisher = node.create_publisher(kind, "cmd_vel", 10)
    twist = Twist()
    twist.linear.x, twist.angular.z = v, w
    message = twist if kind is Twist else TwistStamped(twist=twist)
    while not publisher.get_subscription_count():
        time.sleep(0.1)
    print("here", flush=True)
    for sent in itertools.count(1):
        publisher.publish(message)
        if sent % 10_000 == 0:
            print(sent, flush=True)
        time.sleep(period)


def second_robot():
    """A node with the robot's name."""
    continue_for_ever(node_of("robot"))


def drive():
    command(0.5, 0.0, 0.1)


def drive_stamped():
    command(0.5, 0.0, 0.1, TwistStamped)


def flood():
    """As fast as it can."""
    command(0.3, 0.0, 0.0)


def no_numbers():
    command(math.nan, 0.0, 0.02)


def infinite():
    command(0.1, math.inf, 0.02)


def huge():
    command(1e308, -1e308, 0.02)


def wrong_type():
    """A sentence on the topic of commands."""
    node = node_of("talker")
    publisher = node.create_publisher(String, "cmd_vel", 10)
    continue_for_ever(node, lambda: publisher.publish(String(data="drive on")))


def broken_bytes():
    """Bytes that are no Twist."""
    node = node_of("broken")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    while not publisher.get_subscription_count():
        time.sleep(0.1)

    def send():
        for raw in (b"\x00\x01\x00\x00", b"\x00\x01\x00\x00" + b"\xff" * 20, b"\x07\x77" + b"\xff" * 50):
            publisher.publish(raw)

    continue_for_ever(node, send)


def impostor():
    """Says where the robot is and what time it is, and is wrong."""
    node = node_of("robot")
    odom, clock = (
        node.create_publisher(kind, name, 10) for kind, name in ((Odometry, "odom"), (Clock, "/clock"))
    )
    lie = Odometry()
    lie.pose.pose.position.x = 1e6

    def both():
        odom.publish(lie)
        clock.publish(Clock())

    continue_for_ever(node, both)


def crowd():
    """A hundred subscriptions that no one reads."""
    node = node_of("crowd")
    for _ in range(100):
        node.create_subscription(LaserScan, "scan", lambda scan: None, 10)
    print("here", flush=True)
    while rclpy.ok():
        time.sleep(0.1)


def leader():
    """Wait until the leader has driven off."""
    node, ways = node_of("watcher"), [0.0]
    node.create_subscription(Odometry, "leader/odom", lambda m: ways.append(m.pose.pose.position.x), 10)
    while ways[-1] <= 0.1:
        rclpy.spin_once(node)
    print(json.dumps({"way": ways[-1]}))


def joint():
    """Command an angle until the joint is there."""
    node, angles = node_of("operator"), [0.0]
    node.create_subscription(JointState, "joint_states", lambda m: angles.append(m.position[0]), 10)
    publisher = node.create_publisher(Float64, "joint_commands", 10)
    while abs(angles[-1] - 0.5) >= 0.01:
        publisher.publish(Float64(data=0.5))
        rclpy.spin_once(node, timeout_sec=0.1)
    print(json.dumps({"angle": angles[-1]}))


if __name__ == "__main__":
    try:
        globals()[sys.argv[1]]()
    except Exception:
        if rclpy.ok():  # else it had to end
            raise
