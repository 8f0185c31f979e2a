"""Drivers that can be armed: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger


class Driver(Node):
    """As one would write it."""

    type, service, speed = SetBool, "/arm", 0.3

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.armed = False
        self.create_service(self.type, self.service, self.arm)
        self.create_timer(0.1, self.drive)

    def arm(self, request, response):
        self.armed = request.data
        response.success = True
        response.message = "armed" if self.armed else "disarmed"
        return response

    def drive(self):
        msg = Twist()
        if self.armed:
            msg.linear.x = self.speed
        self.publisher.publish(msg)


class DriverThatStartsATimer(Node):
    """A design of its own: sends commands only while it is armed, and one more to stop."""

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 1)
        self.timer = self.create_timer(0.05, self.drive, autostart=False)
        self.create_service(SetBool, "arm", self.arm)

    def arm(self, request, response):
        if request.data:
            self.timer.reset()
        else:
            self.timer.cancel()
            self.stop()
        return SetBool.Response(success=True, message="Armed." if request.data else "Disarmed.")

    def stop(self):
        self.publisher.publish(Twist())

    def drive(self):
        self.publisher.publish(Twist(linear=Vector3(x=0.3)))


def main(args=None):
    """Functions, threads, and a coroutine that answers."""
    rclpy.init(args=args)
    node = Node("motors")
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    speed = 0.0

    async def on_arm(request, response):
        nonlocal speed
        speed = 0.3 if request.data else 0.0
        node.get_logger().info(f"arm: {request.data}")
        response.success, response.message = True, f"Motors {'armed' if request.data else 'disarmed'}"
        return response

    def on_timer():
        msg = Twist()
        msg.linear.x = speed
        publisher.publish(msg)

    node.create_service(SetBool, "arm", on_arm, callback_group=ReentrantCallbackGroup())
    node.create_timer(0.1, on_timer)
    executor = MultiThreadedExecutor(2)
    rclpy.spin(node, executor)


class StopsAtOnce(Driver):
    """Sends a zero in the answer already."""

    def arm(self, request, response):
        if not request.data:
            self.publisher.publish(Twist())
        return super().arm(request, response)


class MisspeltService(Driver):
    service = "/armed"


class TriggerForSetBool(Driver):
    type = Trigger


class ArmedFromTheStart(Driver):
    def __init__(self):
        super().__init__()
        self.armed = True


class Toggles(Driver):
    def arm(self, request, response):
        self.armed = not self.armed
        return SetBool.Response(success=True, message="armed" if request.data else "disarmed")


class ForgetsSelf(Driver):
    def arm(self, request, response):
        armed = request.data
        return SetBool.Response(success=True, message="armed" if armed else "disarmed")


class ForgetsReturn(Driver):
    def arm(self, request, response):
        self.armed = request.data


class SuccessNeverSet(Driver):
    def arm(self, request, response):
        self.armed = request.data
        return response


class AlwaysSaysArmed(Driver):
    def arm(self, request, response):
        self.armed = request.data
        return SetBool.Response(success=True, message="armed")


class SuccessIsTheRequest(Driver):
    """Takes success for the state: a successful disarming is a success, too."""

    def arm(self, request, response):
        super().arm(request, response)
        response.success = request.data
        return response


class DrivesOnlyOnce(Driver):
    """One command in the service in place of one at each tick."""

    def arm(self, request, response):
        if request.data:
            self.publisher.publish(Twist(linear=Vector3(x=0.3)))
        return SetBool.Response(success=True, message="armed" if request.data else "disarmed")

    def drive(self):
        pass


class DrivesInTheService(Driver):
    """Stays in the callback for as long as it is armed: it can't receive that it should stop."""

    def arm(self, request, response):
        self.armed = request.data
        while self.armed:
            super().drive()
            self.get_clock().sleep_for(rclpy.duration.Duration(seconds=0.1))
        return SetBool.Response(success=True, message="disarmed")

    def drive(self):
        pass


class WordForBool(Driver):
    def arm(self, request, response):
        self.armed = request.data
        response.success = "yes"
        return response


class NeverComesBack(Driver):
    """A loop without end in the callback."""

    def arm(self, request, response):
        while True:
            pass


class DoesTheOpposite(Driver):
    def arm(self, request, response):
        self.armed = not request.data
        return SetBool.Response(success=True, message="armed" if self.armed else "disarmed")


class TurnsInPlaceOfDriving(Driver):
    def drive(self):
        msg = Twist()
        if self.armed:
            msg.angular.z = 0.3
        self.publisher.publish(msg)


class LeavesTheStopToTheRobot(DriverThatStartsATimer):
    """It stops only because this robot does so by itself."""

    def stop(self):
        pass


class PublishesNothing(Driver):
    def drive(self):
        Twist(linear=Vector3(x=0.3 if self.armed else 0.0))


class SecondYesSwitchesOff(Driver):
    def arm(self, request, response):
        self.armed = request.data and not self.armed
        response.success, response.message = True, "armed" if request.data else "disarmed"
        return response
