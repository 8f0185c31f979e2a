"""Plans of a delivery robot: right ones in three styles, and wrong ones, each named by its defect."""

from functools import partial

import rclpy
from geometry_msgs.msg import PoseArray, PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import BatteryState, Image, LaserScan
from std_msgs.msg import String
from warehouse_msgs.msg import Order

from grader.exercises.warehouse import LATCHED, publishes, sketch, subscribes

SCAN = subscribes("/scan", LaserScan, qos_profile_sensor_data)
PEOPLE, OBSTACLES = ("/people", PoseArray), ("/obstacles", PoseArray)
POSE, GOAL, COMMANDS = ("/robot_pose", PoseStamped), ("/goal_pose", PoseStamped), ("/cmd_vel", Twist)
PARTS = ("partial", "subscribes", "publishes", "sketch", "plan", "paper", "drawn")


def plan(**changes):
    """The right plan, with other lines for some programs."""
    right = {
        "perception": [
            SCAN,
            subscribes("/map", OccupancyGrid, LATCHED),
            publishes(*POSE),
            publishes(*PEOPLE),
            publishes(*OBSTACLES),
        ],
        "reader": [subscribes("/image", Image, qos_profile_sensor_data), publishes("/label", String)],
        "decision": [
            subscribes("/orders", Order, LATCHED),
            subscribes("/battery_state", BatteryState),
            subscribes("/dock_pose", PoseStamped, LATCHED),
            subscribes("/label", String),
            publishes(*GOAL),
            publishes("/state", String),
        ],
        "control": [
            subscribes("/map", OccupancyGrid, LATCHED),
            subscribes(*POSE),
            subscribes(*PEOPLE),
            subscribes(*OBSTACLES),
            subscribes(*GOAL),
            publishes(*COMMANDS),
        ],
    }
    return right | changes


def paper(lines):
    """Run a plan, given as lists."""
    sketch({name: lambda ends=ends: ends for name, ends in lines.items()})()


def drawn(more=(), less=(), other=None):
    """The right plan; more: (program, line) to be added; less: (program, topic) to be left out."""
    right = plan()
    for program, topic in less:
        right[program] = [line for line in right[program] if line.topic != topic]
    for program, line in more:
        right[program] = [*right[program], line]
    right.update(other or {})
    paper({name: lines for name, lines in right.items() if lines})


def right():
    drawn()


def with_names_of_its_own():
    """Relative names, and profiles that were made by hand."""
    late = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    reader = [subscribes("image", Image, qos_profile_sensor_data), publishes("label", String, 1)]
    control = [subscribes("map", OccupancyGrid, late), *plan()["control"][1:]]
    drawn(other={"reader": reader, "control": control})


def decision_takes_the_nearest_order():
    """A design of its own: decision receives where the robot is."""
    drawn(more=[("decision", subscribes(*POSE))])


def control_has_a_collision_monitor():
    """A design of its own: control receives the scans, too, as Nav2's collision monitor does."""
    drawn(more=[("control", SCAN)])


class Part(Node):
    """A node that is given its ends."""

    def __init__(self, name, lines):
        super().__init__(name)
        for line in lines:
            if line.kind == "subscription":
                self.create_subscription(line.type, line.topic, lambda message: None, line.profile)
            else:
                publisher = self.create_publisher(line.type, line.topic, line.profile)
                self.create_timer(0.25, partial(publisher.publish, line.type()))


PARTS = (*PARTS, "Part")


def with_nodes_of_its_own():
    rclpy.init()
    executor = MultiThreadedExecutor()
    for name, lines in plan().items():
        lines = [line for line in lines if line.topic != "/scan"]
        node = Part(name, lines)
        if name == "perception":
            node.create_subscription(LaserScan, "/scan", lambda scan: None, qos_profile_sensor_data)
        executor.add_node(node)
    executor.spin()


def god_node():
    lines = [line for lines in plan().values() for line in lines]
    paper({"delivery_robot": lines})


def without_a_reader():
    drawn(other={"reader": []})


def two_drivers():
    drawn(more=[("decision", publishes(*COMMANDS))])


def decision_receives_the_lidar():
    drawn(more=[("decision", SCAN)])


def decision_reads_labels():
    """The picture goes to decision, and the reader has its answer for no one."""
    drawn(more=[("decision", subscribes("/image", Image, qos_profile_sensor_data))])


def decision_without_labels():
    """Nothing tells decision what the picture shows."""
    drawn(less=[("decision", "/label")])


def control_knows_orders():
    drawn(more=[("control", subscribes("/orders", Order, LATCHED))])


def safety_through_decision():
    """Decision learns of people, and tells control whether it may drive."""
    drawn(
        more=[
            ("decision", subscribes(*PEOPLE)),
            ("decision", publishes("/stop", String)),
            ("control", subscribes("/stop", String)),
        ],
        less=[("control", "/people")],
    )


def no_one_says_where_to():
    drawn(less=[("decision", "/goal_pose")])


def a_pose_too_few():
    """Another type for the same topic."""
    drawn(
        less=[("perception", "/people"), ("control", "/people")],
        more=[("perception", publishes("/people", PoseStamped))],
    )


def map_as_it_comes():
    drawn(less=[("control", "/map")], more=[("control", subscribes("/map", OccupancyGrid))])


def reliable_picture():
    drawn(less=[("reader", "/image")], more=[("reader", subscribes("/image", Image))])


def empty_plan():
    paper({})
