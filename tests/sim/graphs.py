"""Nodes for pictures of graphs: each is made of what it publishes, receives, offers and asks for."""

from example_interfaces.action import Fibonacci
from example_interfaces.srv import Trigger
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient, ActionServer
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import LivelinessPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String

LATE, EARLY = (QoSProfile(depth=1, deadline=Duration(seconds=seconds)) for seconds in (0.5, 0.1))
ALIVE = QoSProfile(depth=1, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC)
LEASE = QoSProfile(depth=1, liveliness_lease_duration=Duration(seconds=1))
TYPES = {"odom": Odometry, "scan": LaserScan}


def node(name, gives=(), takes=(), offers=(), asks=(), does=(), wants=()):
    """A function that makes a node. gives, takes: topics, or pairs of a topic and its settings."""

    def make():
        made = Node(name)
        for topic, qos in map(_pair, gives):
            publisher = made.create_publisher(TYPES.get(topic, String), topic, qos)
            made.create_timer(0.1, lambda to=publisher: to.publish(to.msg_type()))
        for topic, qos in map(_pair, takes):
            made.create_subscription(TYPES.get(topic, String), topic, lambda message: None, qos)
        for service in offers:
            made.create_service(Trigger, service, lambda request, response: response)
        for service in asks:
            made.create_client(Trigger, service)
        made.kept = [ActionServer(made, Fibonacci, action, lambda goal: None) for action in does]
        made.kept += [ActionClient(made, Fibonacci, action) for action in wants]
        return made

    make.__name__ = name
    return make


def _pair(topic):
    return topic if isinstance(topic, tuple) else (topic, 10)


DELIVERY = [  # with the robot 15 nodes, and five connections that don't come about
    node("camera", [("image", qos_profile_sensor_data)]),
    node("detector", ["objects"], ["image"]),
    node("planner", ["plan"], ["objects", "map", "odom"], wants=["drive_to"]),
    node("map_server", ["map"], offers=["load_map"]),
    node("localizer", ["pose"], [("scan", qos_profile_sensor_data), "odom", "map"]),
    node("controller", ["cmd_raw"], ["plan", "pose"], does=["drive_to"]),
    node("guard", ["command"], ["cmd_raw", ("scan", qos_profile_sensor_data)], offers=["stop"]),
    node("battery", [("level", LATE)]),
    node("dashboard", [], [("level", EARLY), "pose"], asks=["stop"]),
    node("logger", [], ["objects", "polan"]),
    node("joystick", ["joy"]),
    node("teleop", ["cmd_raw"], ["joy"], asks=["load_maps"]),
    node("speaker", [], ["say"]),
    node("mission", ["say"], wants=["drive_too"]),
]
