"""Robots that stop before a wall: right ones, and wrong ones named by their defect."""

import math

import numpy as np
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Stopper(Node):
    """As one would write it."""

    topic, scan, limit, speed = "/cmd_vel", "/scan", 1.0, 0.3

    def __init__(self):
        super().__init__("stopper")
        self.publisher = self.create_publisher(Twist, self.topic, 10)
        self.create_subscription(LaserScan, self.scan, self.look, 10)

    def look(self, msg):
        command = Twist()
        command.linear.x = self.choose(min(msg.ranges))
        self.publisher.publish(command)

    def choose(self, nearest):
        return self.speed if nearest > self.limit else 0.0


class ReactiveStop(Node):
    """A tutorial's controller: the scan is remembered, a timer decides."""

    def __init__(self):
        super().__init__("reactive_stop_node")
        qos = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.laser_sub = self.create_subscription(LaserScan, "scan", self.laser_callback, qos)
        self.cmd_vel_pub = self.create_publisher(Twist, "cmd_vel", 10)
        self.min_distance = float("inf")
        self.stop_distance = 1.0
        self.timer = self.create_timer(0.1, self.timer_callback)

    def laser_callback(self, msg):
        self.min_distance = min(msg.ranges)

    def timer_callback(self):
        twist = Twist()
        if self.min_distance < self.stop_distance:
            twist.linear.x = 0.0
            self.get_logger().info(f"Obstacle at {self.min_distance:.2f} m, stopping", once=True)
        else:
            twist.linear.x = 0.2
        self.cmd_vel_pub.publish(twist)


def main_as_in_tutorials(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("stop_at_wall")
    pub = node.create_publisher(Twist, "/cmd_vel", 10)

    def callback(msg):
        valid = [r for r in msg.ranges if msg.range_min < r < msg.range_max]
        cmd = Twist()
        if not valid or min(valid) >= 1.0:
            cmd.linear.x = 0.3
        pub.publish(cmd)

    node.create_subscription(LaserScan, "/scan", callback, qos_profile_sensor_data)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        if rclpy.ok():
            rclpy.try_shutdown()


class AllAtOnce(Stopper):
    """A design of its own: numpy, and a comparison that becomes the speed."""

    def look(self, msg):
        command = Twist()
        command.linear.x = 0.3 * float((np.array(msg.ranges) > 1.0).all())
        self.publisher.publish(command)


class AheadOnly(Stopper):
    """Looks at 21 rays, and at nothing else."""

    def look(self, msg):
        ranges = np.array(msg.ranges)
        command = Twist()
        command.linear.x = 0.3 * float(np.nanmin(np.roll(ranges, 10)[:21]) > 1.0)
        self.publisher.publish(command)


class OneRay(Stopper):
    """Straight ahead: enough before a flat wall, and for nothing else."""

    async def look(self, msg):
        self.publisher.publish(Twist() if msg.ranges[0] < 1.0 else self.ahead())

    def ahead(self):
        command = Twist()
        command.linear.x = 0.25
        return command


class OneRaySlowly(OneRay):
    """Still passes the post when the run ends, a meter away from it."""

    def ahead(self):
        command = Twist()
        command.linear.x = 0.225
        return command


class WrongWayRound(Stopper):
    def choose(self, nearest):
        return self.speed if nearest < self.limit else 0.0


class StopsLate(Stopper):
    limit = 0.5


class StopsEarly(Stopper):
    limit = 1.5


class Centimeters(Stopper):
    limit = 100.0


class LooksForTheFarthest(Stopper):
    def look(self, msg):
        command = Twist()
        command.linear.x = self.choose(max(msg.ranges))
        self.publisher.publish(command)


class NeverStops(Stopper):
    limit = -1.0


class SilentWhenNear(Stopper):
    def look(self, msg):
        if min(msg.ranges) > 1.0:
            super().look(msg)


class SlowAndSilent(SilentWhenNear):
    """Stops in time, for it is slow; but only because the robot stops by itself."""

    speed = 0.15


class OnlyOnce(Stopper):
    """Publishes the first command, and no other."""

    done = False

    def look(self, msg):
        if not self.done:
            super().look(msg)
        self.done = True


class Backwards(Stopper):
    speed = -0.3


class Silent(Stopper):
    def look(self, msg):
        Twist().linear.x = 0.3


class MisspeltTopic(Stopper):
    topic = "/cmd_val"


class MisspeltScan(Stopper):
    scan = "/scna"


class ComparesTheList(Stopper):
    def look(self, msg):
        command = Twist()
        if msg.ranges > 1.0:
            command.linear.x = 0.3
        self.publisher.publish(command)


class WholeNumber(Stopper):
    def choose(self, nearest):
        return 1 if nearest > self.limit else 0


class CreepsOn(Stopper):
    """Brakes over the last meter, and never stops."""

    def choose(self, nearest):
        return 0.3 if nearest > 1.0 else 0.02 * math.copysign(1.0, nearest)


class TurnsInPlaceOfDriving(Stopper):
    def look(self, msg):
        command = Twist()
        if min(msg.ranges) > 1.0:
            command.angular.z = 0.3
        self.publisher.publish(command)


class LeastByMethod(Stopper):
    def look(self, msg):
        return msg.ranges.min()


class LeavesOutInfinity(Stopper):
    """Where nothing is in range, no ray is left."""

    def look(self, msg):
        command = Twist()
        command.linear.x = self.choose(min(ray for ray in msg.ranges if math.isfinite(ray)))
        self.publisher.publish(command)
