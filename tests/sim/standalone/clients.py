"""ROS 2 programs that share a domain with the robot and know nothing of it: python clients.py NAME SECONDS"""

import json
import math
import sys
import time

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.parameter_client import AsyncParameterClient
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Float64, String


def node_of(name):
    rclpy.init()
    return Node(name)


def spin(node, seconds, each=lambda: None):
    """Until the time is over; then one line of JSON is printed by the caller."""
    end = time.time() + seconds
    while time.time() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
        each()


def listen(seconds):
    """Count scans, and keep the last odometry."""
    node, scans, odoms = node_of("listener"), [], []
    node.create_subscription(LaserScan, "scan", scans.append, 10)
    node.create_subscription(Odometry, "odom", odoms.append, 10)
    end = time.time() + 20
    while not (scans and odoms) and time.time() < end:  # until they have found each other
        rclpy.spin_once(node, timeout_sec=0.1)
    scans.clear()
    began = time.time()
    spin(node, seconds)
    last, stamp = odoms[-1], scans[-1].header.stamp
    print(json.dumps({
        "rate": len(scans) / (time.time() - began), "age": time.time() - stamp.sec - stamp.nanosec / 1e9,
        "frame": scans[-1].header.frame_id, "x": last.pose.pose.position.x, "v": last.twist.twist.linear.x,
    }))  # fmt: skip


def parameters(seconds):
    """Ask the robot for the names of its parameters, as `ros2 param list` does."""
    node = node_of("curious")
    client = AsyncParameterClient(node, "robot")
    client.wait_for_services(20.0)
    future = client.list_parameters()
    rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
    print(json.dumps(future.result().result.names))


def command(seconds, v, w, period, kind=Twist):
    node = node_of("commander")
    publisher = node.create_publisher(kind, "cmd_vel", 10)
    twist = Twist()
    twist.linear.x, twist.angular.z = v, w
    message = twist if kind is Twist else TwistStamped(twist=twist)
    end = time.time() + 30
    while not publisher.get_subscription_count() and time.time() < end:  # until they have found each other
        time.sleep(0.1)
    sent, end = 0, time.time() + seconds
    while time.time() < end:
        publisher.publish(message)
        sent += 1
        time.sleep(period)
    print(json.dumps({"sent": sent}))


def drive(seconds):
    command(seconds, 0.5, 0.0, 0.1)


def drive_stamped(seconds):
    command(seconds, 0.5, 0.0, 0.1, TwistStamped)


def flood(seconds):
    """As fast as it can."""
    command(seconds, 0.3, 0.0, 0.0)


def no_numbers(seconds):
    command(seconds, math.nan, 0.0, 0.02)


def infinite(seconds):
    command(seconds, 0.1, math.inf, 0.02)


def huge(seconds):
    command(seconds, 1e308, -1e308, 0.02)


def wrong_type(seconds):
    """A sentence on the topic of commands."""
    node = node_of("talker")
    publisher = node.create_publisher(String, "cmd_vel", 10)
    spin(node, seconds, lambda: publisher.publish(String(data="drive on")))


def broken_bytes(seconds):
    """Bytes that are no Twist."""
    node = node_of("broken")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    for raw in (b"\x00\x01\x00\x00", b"\x00\x01\x00\x00" + b"\xff" * 20, b"\x07\x77" + b"\xff" * 50):
        spin(node, seconds / 3, lambda raw=raw: publisher.publish(raw))


def impostor(seconds):
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

    spin(node, seconds, both)


def crowd(seconds):
    """A hundred subscriptions that nobody reads."""
    node = node_of("crowd")
    for _ in range(100):
        node.create_subscription(LaserScan, "scan", lambda scan: None, 10)
    print("here", flush=True)
    time.sleep(seconds)


def leader(seconds):
    """Wait until the leader has driven off."""
    node, ways = node_of("watcher"), []
    node.create_subscription(Odometry, "leader/odom", lambda m: ways.append(m.pose.pose.position.x), 10)
    end = time.time() + seconds
    while time.time() < end and not (ways and ways[-1] > 0.1):
        rclpy.spin_once(node, timeout_sec=0.1)
    print(json.dumps({"way": ways[-1]}))


def joint(seconds):
    """Command an angle until the joint is there."""
    node, angles = node_of("operator"), []
    node.create_subscription(JointState, "joint_states", lambda m: angles.append(m.position[0]), 10)
    publisher = node.create_publisher(Float64, "joint_commands", 10)
    end = time.time() + seconds
    while time.time() < end and not (angles and abs(angles[-1] - 0.5) < 0.01):
        publisher.publish(Float64(data=0.5))
        rclpy.spin_once(node, timeout_sec=0.1)
    print(json.dumps({"angle": angles[-1]}))


if __name__ == "__main__":
    globals()[sys.argv[1]](float(sys.argv[2]))
