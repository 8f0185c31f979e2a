"""Navigators: right ones, and wrong ones named by their defect. Each is a main()."""

import itertools
import math
import time
from collections import deque

import numpy as np
import rclpy
from geometry_msgs.msg import Twist
from nav2_msgs.action import NavigateToPose, Spin
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformException, TransformListener

from tests.exercises.navigator.parts import (
    LATCHED,
    Localized,
    carrot,
    cells_of,
    find_path,
    inflate,
    path_message,
    pose_stamped,
    rest_of,
    steer,
    to_cell,
    to_point,
)


class Mapper(Localized):
    """The map with what the lidar sees beside it, plans on both, commands."""

    wall, near_wall, looks = 0.15, 0.3, 2.0  # m

    def __init__(self, name="navigator"):
        super().__init__(name)
        self.info = self.known = self.marked = None
        self.recoveries = 0
        self.command_publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.plan_publisher = self.create_publisher(Path, "/plan", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(LaserScan, "/scan", self.on_scan, 10)
        self.mounts = {}
        self.create_subscription(TFMessage, "/tf_static", self.on_mounts, LATCHED)

    def on_map(self, msg):
        self.info, self.known = msg.info, cells_of(msg)
        self.explained = inflate(self.known, 0.2 / msg.info.resolution)
        self.marked = self.known.copy()

    def on_mounts(self, msg):
        for transform in msg.transforms:
            place, turn = transform.transform.translation, transform.transform.rotation
            self.mounts[transform.child_frame_id] = place.x, place.y, 2 * math.atan2(turn.z, turn.w)

    def lidar_place(self, scan):
        if self.pose is None or scan.header.frame_id not in self.mounts:
            return None
        (x0, y0, yaw0), (x, y, yaw) = self.pose, self.mounts[scan.header.frame_id]
        cos, sin = math.cos(yaw0), math.sin(yaw0)
        return x0 + cos * x - sin * y, y0 + sin * x + cos * y, yaw0 + yaw

    def on_scan(self, scan):
        place = self.lidar_place(scan)
        if self.marked is None or place is None:
            return
        x, y, yaw = place
        ranges = np.array(scan.ranges)
        angles = yaw + scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        hit = (ranges > scan.range_min) & (ranges < self.looks)
        xs, ys = x + ranges[hit] * np.cos(angles[hit]), y + ranges[hit] * np.sin(angles[hit])
        for column, row in {to_cell(self.info, *place) for place in zip(xs, ys, strict=True)}:
            inside = 0 <= column < self.info.width and 0 <= row < self.info.height
            if inside and self.explained[row, column] == 0:
                self.marked[row, column] = 100

    def plan(self, goal):
        reach = 1 / self.info.resolution
        close, near = inflate(self.marked, self.wall * reach), inflate(self.marked, self.near_wall * reach)
        costs = np.where(close == 0, near // 2, close).tolist()
        way = find_path(costs, to_cell(self.info, *self.pose[:2]), to_cell(self.info, *goal))
        points = [to_point(self.info, *cell) for cell in way]
        self.plan_publisher.publish(path_message(points))
        if not points:
            self.recoveries += 1
            self.marked = self.known.copy()
        return points

    def is_blocked(self, path):
        rows, columns = np.nonzero(self.marked != self.known)
        marks = np.array(to_point(self.info, columns, rows))
        return (((marks[:, :, None] - np.array(path).T[:, None]) ** 2).sum(axis=0) < 0.14**2).any()

    def drive(self, speed, turn):
        command = Twist()
        command.linear.x, command.angular.z = float(speed), float(turn)
        self.command_publisher.publish(command)

    def feedback(self, path, began):
        rest = rest_of(path, self.pose)
        distance = math.fsum(math.dist(*pair) for pair in itertools.pairwise(rest))
        return NavigateToPose.Feedback(
            current_pose=pose_stamped(*self.pose),
            navigation_time=(self.get_clock().now() - began).to_msg(),
            number_of_recoveries=self.recoveries,
            distance_remaining=distance,
            estimated_time_remaining=Duration(seconds=distance / 0.4).to_msg(),
        )


class Navigator(Mapper):
    """As the notebook has it; the wrong ones change a part."""

    action, kind, ahead, near = "navigate_to_pose", NavigateToPose, 0.3, 0.1

    def __init__(self):
        super().__init__()
        self.server = ActionServer(
            self,
            self.kind,
            self.action,
            self.execute,
            callback_group=ReentrantCallbackGroup(),
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
        )

    def on_goal(self, request):
        return GoalResponse.ACCEPT

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def goal_of(self, goal_handle):
        position = goal_handle.request.pose.pose.position
        return position.x, position.y

    def execute(self, goal_handle):
        began, goal, path = self.get_clock().now(), self.goal_of(goal_handle), []
        self.recoveries = 0
        while self.is_lost or self.info is None:
            time.sleep(0.1)
        while math.dist(self.pose[:2], goal) > self.near:
            time.sleep(0.1)
            if self.is_lost:
                return self.given_up(goal_handle)
            if self.is_canceled(goal_handle):
                return self.canceled(goal_handle)
            if not path or self.is_blocked(path):
                path = self.plan(goal)
            if path:
                self.drive(*steer(self.pose, carrot(path, self.pose, self.ahead)))
                self.tell(goal_handle, path, began)
            else:
                self.drive(0.0, 0.0)
        return self.arrived(goal_handle)

    def given_up(self, goal_handle):
        self.drive(0.0, 0.0)
        goal_handle.abort()
        return NavigateToPose.Result()

    def is_canceled(self, goal_handle):
        return goal_handle.is_cancel_requested

    def canceled(self, goal_handle):
        self.drive(0.0, 0.0)
        goal_handle.canceled()
        return NavigateToPose.Result()

    def tell(self, goal_handle, path, began):
        goal_handle.publish_feedback(self.feedback(path, began))

    def arrived(self, goal_handle):
        self.drive(0.0, 0.0)
        goal_handle.succeed()
        return NavigateToPose.Result()


def main_of(node, executor=MultiThreadedExecutor):
    """A main() that spins this node."""

    def main():
        rclpy.init()
        spinner = executor()
        spinner.add_node(node())
        spinner.spin()

    return main


class TimerNavigator(Mapper):
    """Execute only awaits a future; a timer does all the work, and one thread is enough."""

    def __init__(self):
        super().__init__("timer_navigator")
        self.goal_handle = None
        self.server = ActionServer(
            self, NavigateToPose, "/navigate_to_pose", self.execute,
            cancel_callback=lambda goal_handle: CancelResponse.ACCEPT,
        )  # fmt: skip
        self.create_timer(0.1, self.work)

    async def execute(self, goal_handle):
        self.path, self.began, self.done = [], self.get_clock().now(), Future()
        self.goal_handle = goal_handle
        await self.done
        return NavigateToPose.Result()

    def work(self):
        if self.goal_handle is None or self.info is None:
            return
        if self.is_lost:
            self.drive(0.0, 0.0)  # and go on when it is known again
            return
        position = self.goal_handle.request.pose.pose.position
        goal = position.x, position.y
        if self.goal_handle.is_cancel_requested:
            self.finish(self.goal_handle.canceled)
        elif math.dist(goal, self.pose[:2]) < 0.15:
            self.finish(self.goal_handle.succeed)
        else:
            if not self.path or self.is_blocked(self.path):
                self.path = self.plan(goal)
            if self.path:
                self.drive(*steer(self.pose, carrot(self.path, self.pose, 0.25), 0.3))
                self.goal_handle.publish_feedback(self.feedback(self.path, self.began))

    def finish(self, how):
        self.drive(0.0, 0.0)
        how()
        self.goal_handle = None
        self.done.set_result(None)


class ReplansAlways(Navigator):
    """Makes a new plan twice a second, as Nav2's default tree does once; looks at the lidar only then."""

    looks = 1.2
    turn = 0

    def is_blocked(self, path):
        self.turn += 1
        return self.turn % 5 == 0


class TurnsToTheHeading(Navigator):
    """Turns to the goal's heading at the end, as Nav2 does; no one asks for it."""

    def execute(self, goal_handle):
        self.began = self.get_clock().now()
        return super().execute(goal_handle)

    def arrived(self, goal_handle):
        orientation = goal_handle.request.pose.pose.orientation
        heading = 2 * math.atan2(orientation.z, orientation.w)
        while abs(left := math.remainder(heading - self.pose[2], math.tau)) > 0.1:
            self.drive(0.0, math.copysign(0.8, left))
            self.tell(goal_handle, [self.pose[:2]], self.began)
            time.sleep(0.1)
        return super().arrived(goal_handle)


class LooksItUp(Navigator):
    """Asks tf2_ros for the lidar and for the robot."""

    def __init__(self):
        self.buffer = Buffer()
        super().__init__()
        self.listener = TransformListener(self.buffer, self)

    def where(self, frame, stamp):
        try:
            found = self.buffer.lookup_transform("map", frame, stamp).transform
        except TransformException:
            return None
        yaw = 2 * math.atan2(found.rotation.z, found.rotation.w)
        return found.translation.x, found.translation.y, yaw

    @property
    def pose(self):
        return self.where("base_link", Time())

    @property
    def is_lost(self):
        return self.pose is None or super().is_lost

    def lidar_place(self, scan):
        return self.where(scan.header.frame_id, scan.header.stamp)


class InACoroutine(Navigator):
    """Execute awaits the next tick of a timer, and waits there as well while it is lost: one thread is enough."""

    def __init__(self):
        super().__init__()
        self.next = Future()
        self.create_timer(0.1, self.tick)

    def tick(self):
        done, self.next = self.next, Future()
        done.set_result(None)

    async def execute(self, goal_handle):
        began, goal, path = self.get_clock().now(), self.goal_of(goal_handle), []
        while not goal_handle.is_cancel_requested:
            await self.next
            if self.info is None or self.is_lost:
                self.drive(0.0, 0.0)
                continue
            if math.dist(self.pose[:2], goal) < 0.12:
                return self.arrived(goal_handle)
            path = self.plan(goal) if not path or self.is_blocked(path) else path
            self.drive(*(steer(self.pose, carrot(path, self.pose)) if path else (0.0, 0.0)))
            if path:
                self.tell(goal_handle, path, began)
        return self.canceled(goal_handle)


class AsAGenerator(TimerNavigator):
    """What is to be done is a generator; each tick of the timer runs it on to its next `yield`."""

    job = None

    def work(self):
        if self.goal_handle is not None:
            self.job = self.job or self.steps(self.goal_handle.request.pose.pose.position)
            if next(self.job, "over") == "over":
                self.job = None

    def steps(self, position):
        while self.info is None or self.is_lost:
            if self.goal_handle.is_cancel_requested:
                return self.finish(self.goal_handle.canceled)
            yield
        goal = position.x, position.y
        while math.dist(goal, self.pose[:2]) > 0.15:
            if self.goal_handle.is_cancel_requested:
                return self.finish(self.goal_handle.canceled)
            if self.is_lost:
                self.drive(0.0, 0.0)
            else:
                self.follow(goal)
            yield
        return self.finish(self.goal_handle.succeed)

    def follow(self, goal):
        if not self.path or self.is_blocked(self.path):
            self.path = self.plan(goal)
        if self.path:
            self.drive(*steer(self.pose, carrot(self.path, self.pose, 0.25), 0.3))
            self.goal_handle.publish_feedback(self.feedback(self.path, self.began))


class OneAfterTheOther(Navigator):
    """Accepts every goal, and executes them in the order in which they came."""

    def __init__(self):
        super().__init__()
        self.queue, self.busy = deque(), False
        self.server.register_handle_accepted_callback(self.on_accepted)

    def on_accepted(self, goal_handle):
        self.queue.append(goal_handle)
        self.begin_next()

    def begin_next(self):
        if self.queue and not self.busy:
            self.busy = True
            self.queue.popleft().execute()

    def execute(self, goal_handle):
        try:
            return super().execute(goal_handle)
        finally:
            self.busy = False
            self.begin_next()


class Pilot(Localized):
    """A controller of its own: it follows the newest route, and stands without one."""

    def __init__(self):
        super().__init__("pilot")
        self.route = []
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Path, "/route", self.on_route, 10)
        self.create_timer(0.1, self.tick)

    def on_route(self, msg):
        self.route = [(each.pose.position.x, each.pose.position.y) for each in msg.poses]

    def tick(self):
        command = Twist()
        if self.route and not self.is_lost:
            speed, turn = steer(self.pose, carrot(self.route, self.pose))
            command.linear.x, command.angular.z = float(speed), float(turn)
        self.publisher.publish(command)


class Dispatcher(Navigator):
    """The other half: goals, plans and feedback. It sends the pilot a route, and an empty one to stop."""

    def __init__(self):
        super().__init__()
        self.destroy_publisher(self.command_publisher)
        self.routes, self.stands = self.create_publisher(Path, "/route", 10), True

    def plan(self, goal):
        points = super().plan(goal)
        self.routes.publish(path_message(points))
        self.stands = False
        return points

    def drive(self, speed, turn):
        if not (speed or turn or self.stands):
            self.routes.publish(path_message([]))
            self.stands = True


def two_nodes_main():
    rclpy.init()
    executor = MultiThreadedExecutor()
    for node in (Dispatcher(), Pilot()):
        executor.add_node(node)
    executor.spin()


def main_with_try():
    """A tutorial's main(), with try, finally and a rate of its own."""
    rclpy.init()
    node = Navigator()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


main = main_of(Navigator)
timer_main = main_of(TimerNavigator, SingleThreadedExecutor)
replanning_main = main_of(ReplansAlways)  # a design of its own: plans anew in each turn of its loop
turning_main = main_of(TurnsToTheHeading)
looking_up_main = main_of(LooksItUp)
coroutine_main = main_of(InACoroutine, SingleThreadedExecutor)
generator_main = main_of(AsAGenerator, SingleThreadedExecutor)
queue_main = main_of(OneAfterTheOther)


class OtherName(Navigator):
    action = "navigate"


class OtherType(Navigator):
    kind = Spin


class NoActionServer(Node):
    """Publishes commands, and serves no goals."""

    def __init__(self):
        super().__init__("navigator")
        publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: publisher.publish(Twist()))


class Blind(Navigator):
    """Never looks at the lidar."""

    def on_scan(self, scan):
        pass


class PlansOnceASecond(LooksItUp):
    """Keeps to a plan for a second: where its marks block each one, ten plans a second use up its time."""

    planned, last = None, ()

    def plan(self, goal):
        now = self.get_clock().now()
        if self.planned is None or now - self.planned >= Duration(seconds=1.0):
            self.planned, self.last = now, super().plan(goal)
        return self.last


class IgnoresTheFrame(PlansOnceASecond):
    """Takes each scan as measured in base_link, whatever its header says."""

    def on_scan(self, scan):
        scan.header.frame_id = "base_link"
        super().on_scan(scan)


class WithoutInflation(Navigator):
    """Keeps to its first plan: stuck in a wall, it would plan without end and run out of computing time."""

    wall = near_wall = 0.0

    def is_blocked(self, path):
        return False


class GoalInOdom(Navigator):
    """Takes the goal as if it were counted from where the robot started."""

    @property
    def pose(self):
        return self.frames.get("base_link")


class NeedsThePoseAtOnce(Navigator):
    """Does not wait for the localization: the pose is None then."""

    def execute(self, goal_handle):
        left = math.dist(self.pose[:2], self.goal_of(goal_handle))
        self.get_logger().info(f"{left:.1f} m to go")
        return super().execute(goal_handle)


class GivesUpWithoutAPose(Navigator):
    def execute(self, goal_handle):
        if self.pose is None:
            goal_handle.abort()
            return NavigateToPose.Result()
        return super().execute(goal_handle)


class ForgetsToSucceed(Navigator):
    def arrived(self, goal_handle):
        self.drive(0.0, 0.0)
        return NavigateToPose.Result()


class ReturnsNothing(Navigator):
    def arrived(self, goal_handle):
        self.drive(0.0, 0.0)
        goal_handle.succeed()


class SucceedsAtOnce(Navigator):
    near = 1e9


class IsThereTooEarly(Navigator):
    near = 0.8


class RejectsAll(Navigator):
    def on_goal(self, request):
        return GoalResponse.REJECT


class RefusesToCancel(Navigator):
    def on_cancel(self, goal_handle):
        return CancelResponse.REJECT


class IgnoresTheCancel(Navigator):
    def is_canceled(self, goal_handle):
        return False


class DrivesOnAfterTheCancel(Navigator):
    """Stops to steer, but the last command was another."""

    def canceled(self, goal_handle):
        self.drive(0.4, 0.0)
        goal_handle.canceled()
        return NavigateToPose.Result()


class CanceledWithoutAStop(Navigator):
    """Leaves the stop to the robot."""

    def canceled(self, goal_handle):
        goal_handle.canceled()
        return NavigateToPose.Result()


class NoFeedback(Navigator):
    def tell(self, goal_handle, path, began):
        pass


class FeedbackByOdometry(Navigator):
    """Where the robot is since its start, and how far it has come."""

    def feedback(self, path, began):
        feedback = super().feedback(path, began)
        feedback.current_pose = pose_stamped(*self.frames["base_link"])
        feedback.distance_remaining = math.hypot(*self.frames["base_link"][:2])
        return feedback


class NoEstimate(Navigator):
    def feedback(self, path, began):
        feedback = super().feedback(path, began)
        feedback.estimated_time_remaining = Duration().to_msg()
        return feedback


class DrivesInCirclesFirst(Navigator):
    """Takes 50 s to begin."""

    def execute(self, goal_handle):
        for _ in range(500):
            self.drive(0.05, 1.0)
            time.sleep(0.1)
            if goal_handle.is_cancel_requested:
                break
        return super().execute(goal_handle)


class NeverDrives(Navigator):
    def drive(self, speed, turn):
        pass


class NeverPlansWithoutAPath(Navigator):
    """Plans where there is a path that is blocked; and there is none."""

    def plan(self, goal):
        return []


class TellsTheStraightLine(Navigator):
    def feedback(self, path, began):
        feedback = super().feedback(path, began)
        feedback.distance_remaining = math.dist(self.pose[:2], path[-1])
        return feedback


class IsThereFarTooEarly(Navigator):
    near = 2.0


class NeverEnds(Navigator):
    near = 0.0


class KeepsTooFarAway(Navigator):
    """Inflates by 1 m whenever it plans again: then there is no path."""

    def plan(self, goal):
        points = super().plan(goal)
        self.wall = 1.0
        return points


def without_a_server():
    rclpy.init()
    rclpy.spin(Node("navigator"))


other_name = main_of(OtherName)
other_type = main_of(OtherType)
blind = main_of(Blind)
ignores_the_frame = main_of(IgnoresTheFrame)
without_inflation = main_of(WithoutInflation)
goal_in_odom = main_of(GoalInOdom)
needs_the_pose_at_once = main_of(NeedsThePoseAtOnce)
gives_up_without_a_pose = main_of(GivesUpWithoutAPose)
forgets_to_succeed = main_of(ForgetsToSucceed)
returns_nothing = main_of(ReturnsNothing)
succeeds_at_once = main_of(SucceedsAtOnce)
is_there_too_early = main_of(IsThereTooEarly)
rejects_all = main_of(RejectsAll)
refuses_to_cancel = main_of(RefusesToCancel)
ignores_the_cancel = main_of(IgnoresTheCancel)
drives_on_after_the_cancel = main_of(DrivesOnAfterTheCancel)
canceled_without_a_stop = main_of(CanceledWithoutAStop)
no_feedback = main_of(NoFeedback)
feedback_by_odometry = main_of(FeedbackByOdometry)
no_estimate = main_of(NoEstimate)
drives_in_circles_first = main_of(DrivesInCirclesFirst)
never_drives = main_of(NeverDrives)
never_plans_without_a_path = main_of(NeverPlansWithoutAPath)
tells_the_straight_line = main_of(TellsTheStraightLine)
with_one_thread = main_of(Navigator, SingleThreadedExecutor)
is_there_far_too_early = main_of(IsThereFarTooEarly)
never_ends = main_of(NeverEnds)
keeps_too_far_away = main_of(KeepsTooFarAway)
no_action_server = main_of(NoActionServer)

PARTS = ("main_of", *(name for name, item in list(vars().items()) if isinstance(item, type)))
