"""Servers that turn the robot: right ones, and wrong ones named by their defect."""

import math
import time

import rclpy
from geometry_msgs.msg import Twist
from nav2_msgs.action import Spin
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

PARTS = ("ThreadedSpin",)


class SpinServer(Node):
    speed, step = 0.5, 0.05

    def __init__(self):
        super().__init__("spin_server")
        self.yaw, self.turned = 0.0, 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Odometry, "/odom", self.on_odometry, 10)
        self.server = ActionServer(self, Spin, "/spin", self.execute, cancel_callback=self.on_cancel)

    def on_odometry(self, msg):
        q = msg.pose.pose.orientation
        yaw = 2.0 * math.atan2(q.z, q.w)
        self.add(yaw)
        self.yaw = yaw

    def add(self, yaw):
        self.turned += math.remainder(yaw - self.yaw, math.tau)

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    async def execute(self, goal_handle):
        target = goal_handle.request.target_yaw
        self.turned = 0.0
        while abs(self.turned) < abs(target):
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle)
            self.turn(math.copysign(self.speed, target))
            self.tell(goal_handle)
            await self.pause(self.step)
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()

    def stop(self, goal_handle):
        self.turn(0.0)
        goal_handle.canceled()
        return Spin.Result(error_msg=f"canceled after {self.turned:.2f} rad")

    def tell(self, goal_handle):
        goal_handle.publish_feedback(Spin.Feedback(angular_distance_traveled=self.turned))

    def turn(self, speed):
        msg = Twist()
        msg.angular.z = speed
        self.publisher.publish(msg)

    async def pause(self, seconds):
        done = Future()
        timer = self.create_timer(seconds, lambda: done.set_result(None))
        await done
        self.destroy_timer(timer)


class ThreadedSpin(SpinServer):
    def execute(self, goal_handle):
        target, self.turned = goal_handle.request.target_yaw, 0.0
        rate = self.create_rate(20)
        while abs(target) - abs(self.turned) > 0.03:
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle)
            left = target - self.turned
            self.turn(math.copysign(min(1.0, abs(left) + 0.1), left))
            self.tell(goal_handle)
            rate.sleep()
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()


def main_with_threads_and_rate():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(ThreadedSpin())
    executor.spin()


class SpinByOdometry(SpinServer):
    """Each message of /odom steers; execute only waits for the end."""

    def __init__(self):
        super().__init__()
        self.goal = None

    async def execute(self, goal_handle):
        self.goal, self.turned, self.over = goal_handle, 0.0, Future()
        return await self.over

    def on_odometry(self, msg):
        super().on_odometry(msg)
        if self.goal is None:
            return
        left = self.goal.request.target_yaw - self.turned
        if self.goal.is_cancel_requested:
            self.end(self.goal.canceled, f"stopped at {self.turned:.3f} rad")
        elif abs(left) < 0.02:
            self.end(self.goal.succeed, "")
        else:
            self.turn(max(-0.8, min(0.8, 1.5 * left)))
            self.goal.publish_feedback(Spin.Feedback(angular_distance_traveled=abs(self.turned)))

    def end(self, how, text):
        self.turn(0.0)
        how()
        self.goal = None
        self.over.set_result(Spin.Result(error_msg=text))


class SpinByTime(SpinServer):
    """A design of its own: subscribes to /odom, but turns by the clock: right where nothing slips."""

    async def execute(self, goal_handle):
        target, self.turned = goal_handle.request.target_yaw, 0.0
        for _ in range(round(abs(target) / 0.05)):
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle)
            self.turn(math.copysign(0.5, target))
            self.tell(goal_handle)
            await self.pause(0.1)
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()


class MisspeltName(SpinServer):
    def __init__(self):
        Node.__init__(self, "spin_server")
        self.yaw, self.turned = 0.0, 0.0
        self.create_subscription(Odometry, "/odom", self.on_odometry, 10)
        self.server = ActionServer(self, Spin, "/spinn", self.execute)


class NoOdometry(SpinServer):
    def __init__(self):
        Node.__init__(self, "spin_server")
        self.turned = 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.server = ActionServer(self, Spin, "/spin", self.execute, cancel_callback=self.on_cancel)


class SleepsWithOneThread(SpinServer):
    """No one receives /odom while it sleeps, so it turns forever."""

    async def pause(self, seconds):
        time.sleep(seconds)


class JumpsAtPi(SpinServer):
    """The difference to where it began: jumps where the yaw goes from pi to -pi."""

    async def execute(self, goal_handle):
        self.begin = self.yaw
        return await super().execute(goal_handle)

    def add(self, yaw):
        self.turned = yaw - getattr(self, "begin", 0.0)


class AddsWithoutWrapping(SpinServer):
    def add(self, yaw):
        self.turned += yaw - self.yaw


class NeverAdds(SpinServer):
    def add(self, yaw):
        pass


class NeverKeepsTheYaw(SpinServer):
    """Each step is one from the start."""

    def add(self, yaw):
        self.turned += math.remainder(yaw, math.tau)


class AlwaysLeft(SpinServer):
    def turn(self, speed):
        super().turn(abs(speed))


class Degrees(SpinServer):
    """Takes target_yaw for degrees."""

    def add(self, yaw):
        self.turned += math.degrees(math.remainder(yaw - self.yaw, math.tau))


class NeverStopsAtTheEnd(SpinServer):
    def turn(self, speed):
        if speed:
            super().turn(speed)


class TooFast(SpinServer):
    speed, step = 2.5, 0.2


class NeverTurns(SpinServer):
    def turn(self, speed):
        pass


class KeepsTheOldAngle(SpinServer):
    """self.turned isn't set to 0 with a new goal."""

    async def execute(self, goal_handle):
        target = goal_handle.request.target_yaw
        while abs(self.turned) < abs(target):
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle)
            self.turn(math.copysign(self.speed, target))
            self.tell(goal_handle)
            await self.pause(self.step)
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()


class NoFeedback(SpinServer):
    def tell(self, goal_handle):
        pass


class TellsTheTarget(SpinServer):
    def tell(self, goal_handle):
        target = goal_handle.request.target_yaw
        goal_handle.publish_feedback(Spin.Feedback(angular_distance_traveled=target))


class RefusesToCancel(SpinServer):
    def on_cancel(self, goal_handle):
        return CancelResponse.REJECT


class CanceledButTurnsOn(SpinServer):
    """The status is canceled, and the robot turns on all the same."""

    def stop(self, goal_handle):
        self.create_timer(0.1, lambda: self.turn(self.speed))
        goal_handle.canceled()
        return Spin.Result(error_msg=f"canceled after {self.turned:.2f} rad")


class AsksWhetherToEnd(SpinServer):
    """As the lesson's server: `ends_early` returns a result if the goal has to end now."""

    async def execute(self, goal_handle):
        target, self.turned = goal_handle.request.target_yaw, 0.0
        while abs(self.turned) < abs(target):
            if result := self.ends_early(goal_handle, self.turned, 0.0):
                return result
            self.turn(math.copysign(self.speed, target))
            self.tell(goal_handle)
            await self.pause(self.step)
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()

    def ends_early(self, goal_handle, turned, seconds):
        return self.stop(goal_handle) if goal_handle.is_cancel_requested else None


class CanceledWithoutAStop(AsksWhetherToEnd):
    """Lesson 4's: leaves the stop to the robot."""

    def ends_early(self, goal_handle, turned, seconds):
        if not goal_handle.is_cancel_requested:
            return None
        goal_handle.canceled()
        return Spin.Result(error_msg=f"canceled after {turned:.2f} rad")


class CanceledWithoutAWord(SpinServer):
    def stop(self, goal_handle):
        super().stop(goal_handle)
        return Spin.Result()


class CancelsTooLate(SpinServer):
    """Finishes first."""

    async def execute(self, goal_handle):
        target, self.turned = goal_handle.request.target_yaw, 0.0
        while abs(self.turned) < abs(target):
            self.turn(math.copysign(self.speed, target))
            self.tell(goal_handle)
            await self.pause(self.step)
        self.turn(0.0)
        if goal_handle.is_cancel_requested:
            return self.stop(goal_handle)
        goal_handle.succeed()
        return Spin.Result()


class ForgetsToSucceed(SpinServer):
    async def execute(self, goal_handle):
        goal_handle.succeed = lambda: None
        return await super().execute(goal_handle)


class KeepsTheLastStepOnly(SpinServer):
    def add(self, yaw):
        self.turned = math.remainder(yaw - self.yaw, math.tau)


class PublishesZeros(SpinServer):
    def turn(self, speed):
        self.publisher.publish(Twist())


class SucceedsWithoutTurning(PublishesZeros):
    """It waits for as long as the turn would take."""

    def turn(self, speed):
        super().turn(speed)
        self.turned += speed * self.step

    def add(self, yaw):
        pass


class NewestGoalWins(SpinServer):
    """Right, too: a newer goal replaces the older one."""

    def __init__(self):
        super().__init__()
        self.server.register_handle_accepted_callback(self.on_accepted)

    def on_accepted(self, goal_handle):
        self.current = goal_handle
        goal_handle.execute()

    async def execute(self, goal_handle):
        target, self.turned = goal_handle.request.target_yaw, 0.0
        while abs(self.turned) < abs(target):
            if goal_handle is not self.current:
                goal_handle.abort()
                return Spin.Result(error_msg=f"replaced after {self.turned:.2f} rad")
            if goal_handle.is_cancel_requested:
                return self.stop(goal_handle)
            self.turn(math.copysign(self.speed, target))
            self.tell(goal_handle)
            await self.pause(self.step)
        self.turn(0.0)
        goal_handle.succeed()
        return Spin.Result()
