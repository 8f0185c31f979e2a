"""What the official tutorials have beside turtlesim, in our own words: driver, broadcasters, followers."""

import functools
import json
import math

import rclpy
from geometry_msgs.msg import TransformStamped, Twist
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformBroadcaster, TransformException, TransformListener
from turtlesim.msg import Pose
from turtlesim.srv import Spawn


class Driver(Node):
    """Swims in circles."""

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "turtle1/cmd_vel", 10)
        self.create_timer(0.5, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = 2.0, 1.0
        self.publisher.publish(command)


class Nudge(Node):
    """Lets turtle1 swim ahead once, 15 s after the beginning."""

    def __init__(self):
        super().__init__("nudge")
        self.publisher = self.create_publisher(Twist, "turtle1/cmd_vel", 10)
        self.timer = self.create_timer(15.0, self.drive)

    def drive(self):
        self.timer.cancel()
        command = Twist()
        command.linear.x = 2.0
        self.publisher.publish(command)


class Broadcaster(Node):
    """Tells where the turtle `turtlename` is in the world."""

    def __init__(self):
        super().__init__("broadcaster")
        self.turtle = self.declare_parameter("turtlename", "turtle").value
        self.broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self.turtle}/pose", self.tell, 1)

    def tell(self, pose):
        sent = TransformStamped()
        sent.header.stamp = self.get_clock().now().to_msg()
        sent.header.frame_id, sent.child_frame_id = "world", self.turtle
        sent.transform.translation.x, sent.transform.translation.y = pose.x, pose.y
        sent.transform.rotation.z = math.sin(pose.theta / 2)
        sent.transform.rotation.w = math.cos(pose.theta / 2)
        self.broadcaster.sendTransform(sent)


class Carrot(Node):
    """A frame beside turtle1: 2 m to its left, or with `moves` on a circle around it."""

    def __init__(self):
        super().__init__("carrot")
        self.moves = self.declare_parameter("moves", False).value
        self.broadcaster = TransformBroadcaster(self)
        self.begin = self.get_clock().now()
        self.create_timer(0.1, self.tell)

    def tell(self):
        now = self.get_clock().now()
        angle = (now - self.begin).nanoseconds * 1e-9 if self.moves else 0.0
        sent = TransformStamped()
        sent.header.stamp = now.to_msg()
        sent.header.frame_id, sent.child_frame_id = "turtle1", "carrot1"
        sent.transform.translation.x = 2.0 * math.sin(angle)
        sent.transform.translation.y = 2.0 * math.cos(angle)
        self.broadcaster.sendTransform(sent)


class Follower(Node):
    """Brings turtle2 into the pond, then to the frame `target_frame`."""

    def __init__(self):
        super().__init__("follower")
        self.target = self.declare_parameter("target_frame", "turtle1").value
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.client = self.create_client(Spawn, "spawn")
        self.spawned = None
        self.publisher = self.create_publisher(Twist, "turtle2/cmd_vel", 1)
        self.create_timer(0.1, self.follow)

    def follow(self):
        if self.spawned is None:
            if self.client.service_is_ready():
                self.spawned = self.client.call_async(Spawn.Request(name="turtle2", x=4.0, y=2.0, theta=0.0))
            return
        if not self.spawned.done():
            return
        try:
            found = self.look().transform.translation
        except TransformException as error:
            self.get_logger().info(f"Not yet: {error}", once=True)
            return
        command = Twist()
        command.angular.z = 4.0 * math.atan2(found.y, found.x)
        command.linear.x = 0.5 * math.hypot(found.x, found.y)
        self.publisher.publish(command)

    def look(self):
        return self.buffer.lookup_transform("turtle2", self.target, Time())


class LateFollower(Follower):
    """Goes to where the target was 5 s ago. What came in the last `margin` s is not counted on."""

    def __init__(self):
        super().__init__()
        self.margin = Duration(seconds=self.declare_parameter("margin", 0.1).value)

    def look(self):
        now = self.get_clock().now() - self.margin
        past = now - Duration(seconds=5.0)
        wait = Duration(seconds=0.05)
        return self.buffer.lookup_transform_full("turtle2", now, self.target, past, "world", wait)


def broadcaster():
    rclpy.init()
    rclpy.spin(Broadcaster())


def follower():
    rclpy.init()
    rclpy.spin(Follower())


def late_follower():
    rclpy.init()
    rclpy.spin(LateFollower())


def driver():
    rclpy.init()
    rclpy.spin(Driver())


def meeting():
    """Waits until turtle2 is where turtle1 is; prints where that was."""
    rclpy.init()
    node, poses = Node("meeting"), {}
    for turtle in ("turtle1", "turtle2"):
        receive = functools.partial(poses.__setitem__, turtle)
        node.create_subscription(Pose, f"{turtle}/pose", receive, 1)
    apart = math.inf
    while apart > 0.1:
        rclpy.spin_once(node)
        if len(poses) == 2:
            one, other = poses["turtle1"], poses["turtle2"]
            apart = math.dist((one.x, one.y), (other.x, other.y))
    print(json.dumps({"turtle1": [one.x, one.y], "apart": apart}))
