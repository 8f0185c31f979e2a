"""Nodes of ours for 06_navigator: those that Nav2's bringup starts beside a navigator, and those that use it.

They are told about the world, so each is made for one: `bringup(world)`.
"""

from __future__ import annotations

import array
import math
import random
from typing import Any, ClassVar

import numpy as np
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped, Twist
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from grader.exercises.navigator.ground import RESOLUTION, Point, drivable, ground
from sim.nanoseconds import SECOND
from sim.ros.messages.template import STAMP, Template
from sim.world import World

AHEAD = SECOND // 10
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def bringup(world: World | str, known: World | None = None) -> list[type[Node]]:
    """The map server and the localization for a world, to run beside a navigator.

    known: the world as the map has it, where something in the real one is in no map.
    """
    world = World.load(world) if isinstance(world, str) else world
    return [made_for(MapServer, world=known or world), made_for(Localization, start=world.start)]


def made_for(node: type[Node], **attributes: Any) -> type[Node]:
    """The same kind of node, with attributes of its own."""
    return type(node.__name__, (node,), attributes | {"__module__": node.__module__})


def grid_message(world: World, cells: np.ndarray) -> OccupancyGrid:
    """Cells, shape (rows, columns), as a map of this world in the frame map."""
    floor, msg = ground(world), OccupancyGrid()
    msg.header.frame_id = "map"
    msg.info.resolution, msg.info.width, msg.info.height = RESOLUTION, floor.columns, floor.rows
    msg.info.origin.position.x, msg.info.origin.position.y = floor.origin
    msg.data = array.array("b", cells.astype(np.int8).tobytes())
    return msg


def pose_message(x: float, y: float, yaw: float = 0.0) -> PoseStamped:
    """A pose in the frame map."""
    msg = PoseStamped()
    msg.header.frame_id = "map"
    msg.pose.position.x, msg.pose.position.y = float(x), float(y)
    msg.pose.orientation.z, msg.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return msg


class MapServer(Node):
    """Publishes the map once on /map, latched: whoever comes later gets it, too. As Nav2's map server does.

    A cell is 0 (free), 100 (occupied) or -1 (unknown).
    """

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("map_server")
        floor = ground(self.world)
        self.publisher = self.create_publisher(OccupancyGrid, "/map", LATCHED)
        cells = np.where(floor.known, np.where(floor.occupied, 100, 0), -1)
        self.publisher.publish(grid_message(self.world, cells))


class CostmapServer(Node):
    """Publishes the map as it is inflated by the robot's size, latched, on /global_costmap/costmap."""

    world: ClassVar[World]
    radius = 0.15  # metres

    def __init__(self) -> None:
        super().__init__("costmap")
        floor = ground(self.world)
        self.publisher = self.create_publisher(OccupancyGrid, "/global_costmap/costmap", LATCHED)
        near = floor.known & (floor.clearance <= self.radius)
        cells = np.where(floor.known, np.where(near, 100, 0), -1)
        self.publisher.publish(grid_message(self.world, cells))


class Localization(Node):
    """Says on /tf, 20 times a second, where the frame odom lies in the frame map.

    As AMCL does, it dates this a little ahead, so that where something was seen just now can be looked up.
    It trusts the odometry, and knows where the robot started; so the answer is always the same. AMCL, which
    does this on a robot, compares the lidar with the map and corrects the answer all the time.
    """

    start: ClassVar[tuple[float, float, float]]

    def __init__(self) -> None:
        super().__init__("localization")
        self.publisher = self.create_publisher(TFMessage, "/tf", 10)
        transform = TransformStamped(child_frame_id="odom")
        transform.header.frame_id = "map"
        x, y, yaw = self.start
        move = transform.transform
        move.translation.x, move.translation.y = x, y
        move.rotation.z, move.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        message = TFMessage(transforms=[transform])
        self.message = Template(message, [f"transforms.0.{field}" for field in STAMP])
        self.create_timer(0.05, self.tell)

    def tell(self) -> None:
        """Publish the transform from map to odom."""
        until = self.get_clock().now().nanoseconds + AHEAD
        self.publisher.publish(self.message.fill(*divmod(until, SECOND)))


class Wanderer(Node):
    """Drives the robot in curves, so that it looks in all directions; the run's seed says which."""

    def __init__(self) -> None:
        super().__init__("wanderer")
        self.speed, self.turn = random.uniform(0.3, 0.5), random.choice((-1, 1)) * random.uniform(0.5, 0.8)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        """Go on."""
        msg = Twist()
        msg.linear.x, msg.angular.z = self.speed, self.turn
        self.publisher.publish(msg)


class PointClicker(Node):
    """Clicks on the map twice a second, as RViz' tool Publish Point does: PointStamped on /clicked_point."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("point_clicker")
        self.publisher = self.create_publisher(PointStamped, "/clicked_point", 10)
        self.create_timer(0.5, self.click)

    def click(self) -> None:
        """Somewhere inside the world."""
        left, bottom, right, top = self.world.bounds
        msg = PointStamped()
        msg.header.frame_id, msg.header.stamp = "map", self.get_clock().now().to_msg()
        msg.point.x, msg.point.y = random.uniform(left, right), random.uniform(bottom, top)
        self.publisher.publish(msg)


class GoalSender(Node):
    """Sends goals as RViz' tool 2D Goal Pose does, one every 3 s: PoseStamped on /goal_pose."""

    goals: ClassVar[list[Point]]

    def __init__(self) -> None:
        super().__init__("goal_sender")
        self.publisher = self.create_publisher(PoseStamped, "/goal_pose", 10)
        self.left = list(self.goals)
        self.create_timer(3.0, self.send)

    def send(self) -> None:
        """Send the next one."""
        if self.left:
            self.publisher.publish(pose_message(*self.left.pop(0)))


class Planner(Node):
    """Publishes a way from the world's start to its goal once a second: nav_msgs/Path on /plan."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("planner_server")
        self.publisher = self.create_publisher(Path, "/plan", 10)
        self.path = Path(poses=[pose_message(x, y) for x, y in drivable(self.world)])
        self.path.header.frame_id = "map"
        self.create_timer(1.0, lambda: self.publisher.publish(self.path))


class GoalClient(Node):
    """Sends a robot to a goal with Nav2's action NavigateToPose, says how far it is, and reports the result.

    cancel_after: seconds after which it changes its mind, cancels, and 2 s later sends the goal again.
    """

    goal: ClassVar[Point]
    cancel_after: ClassVar[float | None] = None

    def __init__(self) -> None:
        super().__init__("goal_client")
        self.client = ActionClient(self, NavigateToPose, "navigate_to_pose")
        self.patience = self.cancel_after
        self.told = 0
        self.timer = self.create_timer(0.5, self.start)

    def start(self) -> None:
        """Send the goal, as soon as there is a server."""
        if not self.client.server_is_ready():
            return
        self.timer.cancel()
        goal = NavigateToPose.Goal(pose=pose_message(*self.goal))
        goal.pose.header.stamp = self.get_clock().now().to_msg()
        future = self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_answer)

    def on_feedback(self, message: Any) -> None:
        """Say every few seconds how far it is."""
        feedback = message.feedback
        if feedback.navigation_time.sec >= self.told + 5:
            self.told = feedback.navigation_time.sec
            self.get_logger().info(f"{feedback.distance_remaining:.1f} m left after {self.told} s")

    def on_answer(self, future: Any) -> None:
        """Wait for the result, or for a change of mind."""
        self.goal_handle = future.result()
        if not self.goal_handle.accepted:
            self.get_logger().warning("The goal was rejected.")
            return
        self.goal_handle.get_result_async().add_done_callback(self.on_result)
        if self.patience is not None:
            self.timer = self.create_timer(self.patience, self.cancel)
            self.patience = None

    def cancel(self) -> None:
        """Change its mind, and change it again later."""
        self.timer.cancel()
        self.goal_handle.cancel_goal_async()
        self.told = 0
        self.timer = self.create_timer(2.0, self.start)

    def on_result(self, future: Any) -> None:
        """Say how it ended."""
        endings = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "was canceled"}
        answer = future.result()
        message = getattr(answer.result, "error_msg", "")
        self.get_logger().info(f"The goal {endings.get(answer.status, 'was aborted')}. {message}".strip())
