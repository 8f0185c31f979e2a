"""The server of lesson 4b as one program: drive a distance, as Nav2 offers it."""

import math
import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from nav2_msgs.action import DriveOnHeading
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future


class Base(Node):
    """Knows where the robot is, and moves it: what every server that drives needs."""

    def __init__(self, name):
        super().__init__(name)
        self.position, self.yaw = (0.0, 0.0), 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, msg):
        """Store where the robot is and where it points."""
        position, q = msg.pose.pose.position, msg.pose.pose.orientation
        self.position = (position.x, position.y)
        self.yaw = 2 * math.atan2(q.z, q.w)

    def send(self, speed=0.0, turn=0.0):
        """Command a speed, in m/s, and a turn, in rad/s; without arguments: stop."""
        msg = Twist()
        msg.linear.x, msg.angular.z = speed, turn
        self.publisher.publish(msg)

    def on_cancel(self, goal_handle):
        """Accept every cancel request."""
        return CancelResponse.ACCEPT

    async def pause(self, seconds):
        """Wait, and let other callbacks run meanwhile."""
        done = Future()
        group = ReentrantCallbackGroup()
        timer = self.create_timer(seconds, lambda: done.set_result(None), callback_group=group)
        await done
        self.destroy_timer(timer)


class DriveServer(Base):
    """Serves /drive_on_heading. A newer goal replaces an older one."""

    def __init__(self):
        super().__init__("drive_server")
        self.current = None  # the newest goal
        self.server = ActionServer(
            self,
            DriveOnHeading,
            "/drive_on_heading",
            self.execute,
            handle_accepted_callback=self.on_accepted,
            cancel_callback=self.on_cancel,
        )

    def on_accepted(self, goal_handle):
        """From now on this goal is the one that counts."""
        self.current = goal_handle
        goal_handle.execute()

    async def execute(self, goal_handle):
        """Drive until the distance is covered, or until there is a reason to end early."""
        goal, start, meters = goal_handle.request, self.position, 0.0
        begin = self.get_clock().now()
        while meters < goal.target.x:
            seconds = (self.get_clock().now() - begin).nanoseconds / 1e9
            result = self.ends_early(goal_handle, meters, seconds)
            if result is not None:
                return result
            self.send(speed=goal.speed)
            await self.pause(0.05)
            meters = math.dist(start, self.position)
            goal_handle.publish_feedback(DriveOnHeading.Feedback(distance_traveled=meters))
        self.send()
        goal_handle.succeed()
        return DriveOnHeading.Result()

    def ends_early(self, goal_handle, meters, seconds):
        """The result of a goal that has to end now; None if it may continue."""
        allowed = goal_handle.request.time_allowance.sec  # 0: as long as it takes
        if goal_handle is not self.current:  # the robot belongs to the newer goal: don't stop it
            goal_handle.abort()
            return DriveOnHeading.Result(error_msg=f"replaced after {meters:.2f} m")
        if goal_handle.is_cancel_requested:
            self.send()  # stop the robot first, then report it
            goal_handle.canceled()
            return DriveOnHeading.Result(error_msg=f"canceled after {meters:.2f} m")
        if seconds > allowed > 0:
            self.send()
            goal_handle.abort()
            reason = f"only {meters:.2f} m in {allowed} s"
            return DriveOnHeading.Result(error_code=DriveOnHeading.Result.TIMEOUT, error_msg=reason)
        return None


def main(args=None):
    """Serve until a signal ends the program, and stop the robot then."""
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = DriveServer()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.send()
        time.sleep(0.2)  # so that it gets there
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
