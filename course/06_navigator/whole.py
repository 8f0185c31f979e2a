"""The navigator of lesson 6b as one node. What it computes is in planning.py."""

import math
import signal
import time

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import OccupancyGrid, Path
from planning import carrot, cells_of, inflate, rest_of, search, steer, to_cell, to_point, yaw_of
from rclpy.action import ActionServer, CancelResponse
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_ros import Buffer, TransformException, TransformListener

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SPEED, NEAR = 0.4, 0.1  # m/s; m from the goal that are near enough
MARGIN = 0.15  # m that the path keeps from walls


class Navigator(Node):
    """Serves navigate_to_pose: plans, follows the plan, and plans again when something is in the way."""

    ahead = 0.3  # m: how far ahead the point is that it drives to

    def __init__(self):
        super().__init__("navigator")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.grid, self.path, self.goal = None, [], None
        self.plan_publisher = self.create_publisher(Path, "/plan", 10)
        self.command_publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_timer(0.1, self.follow)
        self.server = ActionServer(
            self,
            NavigateToPose,
            "navigate_to_pose",
            self.execute,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )

    # -- what it receives --

    def on_map(self, msg):
        """Store the map, and a copy in which the lidar's obstacles are marked."""
        self.grid, self.known, self.cells = msg, cells_of(msg), cells_of(msg)

    def on_scan(self, scan):
        """Mark what is near, where the map has nothing."""
        if not self.is_ready:
            return
        try:
            x, y, yaw = self.where(scan.header.frame_id, scan.header.stamp)
        except TransformException:
            return  # not known yet; the next scan comes soon
        for ray, distance in enumerate(scan.ranges):
            if scan.range_min < distance < 1.5 and ray % 3 == 0:
                angle = yaw + scan.angle_min + ray * scan.angle_increment
                self.mark(x + distance * math.cos(angle), y + distance * math.sin(angle))

    # -- where it is --

    @property
    def is_ready(self):
        """Whether the map is known, and the robot's pose in it, no older than half a second."""
        try:
            newest = self.buffer.lookup_transform("map", "base_link", Time()).header.stamp
        except TransformException:
            return False
        age = self.get_clock().now() - Time.from_msg(newest)
        return self.grid is not None and age < Duration(seconds=0.5)

    @property
    def pose(self):
        """x, y and yaw of the robot in the map, as new as there is."""
        return self.where("base_link", Time())

    def where(self, frame, stamp):
        """x, y and yaw of a frame in the map at that time; raises TransformException where it isn't known."""
        found = self.buffer.lookup_transform("map", frame, stamp).transform
        return found.translation.x, found.translation.y, yaw_of(found.rotation)

    # -- obstacles and plans --

    def mark(self, x, y):
        """Mark a point as occupied, and forget the path if it passes too near."""
        column, row = to_cell(self.grid.info, x, y)
        inside = 0 <= row < len(self.cells) and 0 <= column < len(self.cells[0])
        if inside and self.cells[row, column] == 0 and not self.is_explained(row, column):
            self.cells[row, column] = 100
            if any(math.dist((x, y), point) < MARGIN for point in self.path):
                self.path = []

    def is_explained(self, row, column):
        """Whether the map has something near: a wall is never measured exactly."""
        return (self.known[max(row - 4, 0) : row + 5, max(column - 4, 0) : column + 5] == 100).any()

    def plan(self, goal):
        """Find a path from the robot to the goal, and publish it."""
        info = self.grid.info
        rows = inflate(self.cells, MARGIN / info.resolution).tolist()
        here, there = to_cell(info, *self.pose[:2]), to_cell(info, *goal)
        self.path = [to_point(info, *cell) for cell in search(rows, here, there)]
        self.plan_publisher.publish(path_message(self.path))
        if not self.path:
            self.cells = self.known.copy()  # recovery: forget the marks, and try again

    # -- driving --

    def drive(self, speed, turn):
        """Command a velocity: m/s and rad/s."""
        command = Twist()
        command.linear.x, command.angular.z = speed, turn
        self.command_publisher.publish(command)

    def follow(self):
        """Ten times a second: drive a bit further along the path."""
        goal = self.goal  # once: another thread may take it away at any moment
        if goal is None:
            return
        if not self.is_ready:
            self.drive(0.0, 0.0)  # no news is bad news
            return
        if not self.path:
            self.plan(goal)
        path = self.path
        if path and math.dist(self.pose[:2], goal) > NEAR:
            self.drive(*steer(self.pose, carrot(path, self.pose, self.ahead)))
        else:
            self.drive(0.0, 0.0)

    # -- the action --

    def execute(self, goal_handle):
        """Set the goal, watch, and report how it ended. The timer drives."""
        position = goal_handle.request.pose.pose.position
        self.path, self.goal = [], (position.x, position.y)
        while not self.is_ready or math.dist(self.pose[:2], (position.x, position.y)) > NEAR:
            if goal_handle.is_cancel_requested:
                return self.finish(goal_handle.canceled)
            path = self.path  # once: another thread may empty self.path at any moment
            if path:
                goal_handle.publish_feedback(self.feedback(path))
            time.sleep(0.5)
        return self.finish(goal_handle.succeed)

    def feedback(self, path):
        """How far it still has to go."""
        feedback = NavigateToPose.Feedback(current_pose=pose_stamped(*self.pose))
        feedback.distance_remaining = len(rest_of(path, self.pose)) * self.grid.info.resolution  # nearly
        feedback.estimated_time_remaining.sec = int(feedback.distance_remaining / SPEED)
        return feedback

    def finish(self, how):
        """Stop the robot first, and then report how the goal ended."""
        self.goal = None
        self.drive(0.0, 0.0)
        how()
        return NavigateToPose.Result()


# -- messages --


def pose_stamped(x, y, yaw=0.0):
    """A pose in the frame map."""
    pose = PoseStamped()
    pose.header.frame_id = "map"
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return pose


def path_message(points):
    """A path in the frame map."""
    path = Path(poses=[pose_stamped(*point) for point in points])
    path.header.frame_id = "map"
    return path


def main(args=None):
    """Run the navigator until Ctrl-C or SIGTERM, then stop the robot."""
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Navigator()
    executor = MultiThreadedExecutor(num_threads=4)  # one waits in execute, the others receive
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass
    finally:
        node.drive(0.0, 0.0)
        time.sleep(0.2)  # so that it gets there
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
