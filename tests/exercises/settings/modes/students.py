"""Mode managers: right ones, and wrong ones named by their defect."""

import enum

import example_interfaces.srv
import rclpy
from geometry_msgs.msg import Twist, Vector3
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

PARTS = ("State",)
MODES = {"idle": (0.0, 0.0), "ahead": (0.4, 0.0), "back": (-0.3, 0.0), "circle": (0.2, 0.8)}


class Manager(Node):
    """As one would write it."""

    name, reset_type = "manager", Trigger

    def __init__(self):
        super().__init__(self.name)
        self.armed = self.bumped = self.touching = False
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Bool, "/bumper", self.on_bumper, 10)
        self.create_timer(0.1, self.drive)
        self.add_on_set_parameters_callback(self.check)
        self.declare_parameter("mode", "idle")
        self.create_service(SetBool, "/arm", self.arm)
        self.create_service(self.reset_type, "/reset", self.reset)

    def check(self, parameters):
        for parameter in parameters:
            if parameter.name == "mode" and parameter.value not in MODES:
                return SetParametersResult(successful=False, reason=f"there is no mode {parameter.value!r}")
        return SetParametersResult(successful=True)

    def arm(self, request, response):
        if request.data and self.bumped:
            response.message = "The robot has bumped into something: call /reset first."
            return response
        self.armed = request.data
        response.success = True
        return response

    def reset(self, request, response):
        self.bumped = False
        response.success, response.message = True, "ready"
        return response

    def on_bumper(self, msg):
        if msg.data and not self.touching:
            self.bump()
        self.touching = msg.data

    def bump(self):
        self.armed, self.bumped = False, True

    def drive(self):
        msg = Twist()
        if self.armed:
            msg.linear.x, msg.angular.z = MODES[self.get_parameter("mode").value]
        self.publisher.publish(msg)


class State(enum.Enum):
    DISARMED = 0
    ARMED = 1
    BUMPED = 2


class StateMachine(Node):
    """A design of its own: one state for several flags; sends nothing but a stop unless it is armed."""

    def __init__(self):
        super().__init__("manager")
        self.state, self.pressed = State.DISARMED, False
        self.mode = "idle"
        self.add_on_set_parameters_callback(self.on_parameters)
        self.declare_parameter("mode", self.mode)
        self.srvs = [
            self.create_service(SetBool, "arm", self.on_arm),
            self.create_service(Trigger, "reset", self.on_reset),
        ]
        self.pub = self.create_publisher(Twist, "cmd_vel", 1)
        self.sub = self.create_subscription(Bool, "bumper", self.on_bumper, 1)
        self.timer = self.create_timer(0.05, self.step)

    def on_parameters(self, params):
        result = SetParametersResult(successful=True)
        for param in params:
            if param.name == "mode":
                result.successful = param.value in MODES
                result.reason = "" if result.successful else "unknown mode; try " + ", ".join(MODES)
                self.mode = param.value if result.successful else self.mode
        return result

    async def on_arm(self, request, response):
        if not request.data:
            self.state = State.BUMPED if self.state is State.BUMPED else State.DISARMED
            self.stop()
        elif self.state is State.BUMPED:
            return SetBool.Response(success=False, message="bumped")
        else:
            self.state = State.ARMED
        return SetBool.Response(success=True, message=self.state.name)

    async def on_reset(self, request, response):
        self.state = State.DISARMED
        response.success = True
        return response

    def on_bumper(self, msg):
        if msg.data and not self.pressed:
            self.state = State.BUMPED
            self.pub.publish(Twist())
        self.pressed = msg.data

    def stop(self):
        self.pub.publish(Twist())

    def step(self):
        if self.state is State.ARMED:
            v, w = MODES[self.mode]
            self.pub.publish(Twist(linear=Vector3(x=v), angular=Vector3(z=w)))


class SilentUnlessArmed(StateMachine):
    """Trusts the robot to stop by itself."""

    def stop(self):
        pass

    def on_bumper(self, msg):
        if msg.data and not self.pressed:
            self.state = State.BUMPED
        self.pressed = msg.data


def main(args=None):
    """A node that is put together in a function, with threads."""
    rclpy.init(args=args)
    node = Node("manager")
    group = ReentrantCallbackGroup()
    state = {"armed": False, "bumped": False, "touching": False}
    publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def on_arm(request, response):
        response.success = not (request.data and state["bumped"])
        response.message = "ok" if response.success else "reset me first"
        if response.success:
            state["armed"] = request.data
        return response

    def on_reset(request, response):
        state["bumped"] = False
        return Trigger.Response(success=True, message="reset")

    def on_bumper(msg):
        if msg.data and not state["touching"]:
            state.update(armed=False, bumped=True)
        state["touching"] = msg.data

    def on_set(parameters):
        if all(p.value in MODES for p in parameters if p.name == "mode"):
            return SetParametersResult(successful=True)
        return SetParametersResult(successful=False, reason="no such mode")

    def tick():
        mode = node.get_parameter("mode").get_parameter_value().string_value
        v, w = MODES[mode if state["armed"] else "idle"]
        msg = Twist()
        msg.linear.x, msg.angular.z = v, w
        publisher.publish(msg)

    node.add_on_set_parameters_callback(on_set)
    node.declare_parameter("mode", "idle")
    node.create_service(SetBool, "/arm", on_arm, callback_group=group)
    node.create_service(Trigger, "/reset", on_reset, callback_group=group)
    node.create_subscription(Bool, "/bumper", on_bumper, 10, callback_group=group)
    node.create_timer(0.1, tick, callback_group=group)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


class ChecksAfterItsStart(Manager):
    """Declares the parameter before anything checks it."""

    def add_on_set_parameters_callback(self, callback):
        self.declare_parameter("mode", "idle")
        super().add_on_set_parameters_callback(callback)

    def declare_parameter(self, name, *rest):
        return None if self.has_parameter(name) else super().declare_parameter(name, *rest)


class AnotherName(Manager):
    name = "mode_manager"


class TriggerOfAnotherPackage(Manager):
    reset_type = example_interfaces.srv.Trigger


class NoReset(Manager):
    def create_service(self, srv_type, srv_name, *arguments, **more):
        if srv_name != "/reset":
            super().create_service(srv_type, srv_name, *arguments, **more)


class ModeNotDeclared(Manager):
    def __init__(self):
        Node.__init__(self, "manager")
        self.armed = self.bumped = False
        self.create_service(SetBool, "/arm", self.arm)
        self.create_service(Trigger, "/reset", self.reset)


class TakesAnyMode(Manager):
    """And then fails at a mode it doesn't know."""

    def check(self, parameters):
        return SetParametersResult(successful=True)


class RefusesWithoutReason(Manager):
    def check(self, parameters):
        return SetParametersResult(successful=all(p.value in MODES for p in parameters))


class ForgetsTheGoodCase(Manager):
    def check(self, parameters):
        if parameters[0].value not in MODES:
            return SetParametersResult(successful=False, reason="no such mode")


class DrivesWithoutArming(Manager):
    def drive(self):
        msg = Twist()
        msg.linear.x, msg.angular.z = MODES[self.get_parameter("mode").value]
        self.publisher.publish(msg)


class ModeReadOnce(Manager):
    def __init__(self):
        super().__init__()
        self.mode = self.get_parameter("mode").value

    def drive(self):
        msg = Twist()
        if self.armed:
            msg.linear.x, msg.angular.z = MODES[self.mode]
        self.publisher.publish(msg)


class NeverDisarms(Manager):
    def arm(self, request, response):
        if not request.data:
            return SetBool.Response(success=True)
        return super().arm(request, response)


class ForgetsReturn(Manager):
    def arm(self, request, response):
        super().arm(request, response)


class DeafToTheBumper(Manager):
    def on_bumper(self, msg):
        pass


class OnlyDisarms(Manager):
    """Stops, but may be armed at once."""

    def bump(self):
        self.armed = False


class RefusesButDrivesOn(Manager):
    def bump(self):
        self.bumped = True


class RefusesInSilence(Manager):
    def arm(self, request, response):
        super().arm(request, response)
        response.message = ""
        return response


class SaysNoButArms(Manager):
    """Forgets to leave after the refusal."""

    def arm(self, request, response):
        response.success = not self.bumped
        response.message = "reset first"
        self.armed = request.data
        return response


class RaisesInPlaceOfRefusing(Manager):
    def arm(self, request, response):
        if request.data and self.bumped:
            raise RuntimeError("call /reset first")
        return super().arm(request, response)


class ResetForgetsTheFlag(Manager):
    def reset(self, request, response):
        return Trigger.Response(success=True, message="ready")


class ResetWithoutSuccess(Manager):
    def reset(self, request, response):
        self.bumped = False
        return response


class ResetArms(Manager):
    """It must not move before someone arms it."""

    def reset(self, request, response):
        self.armed = True
        return super().reset(request, response)


class StuckAtTheWall(Manager):
    """Takes the bumper that is still pressed for a new bump."""

    def on_bumper(self, msg):
        if msg.data:
            self.bump()


class SwappedAxes(Manager):
    def drive(self):
        msg = Twist()
        if self.armed:
            msg.angular.z, msg.linear.x = MODES[self.get_parameter("mode").value]
        self.publisher.publish(msg)


class NeverComesBack(Manager):
    """A loop without end in the callback."""

    def arm(self, request, response):
        while True:
            pass


class LeavesTheStopToTheRobot(StateMachine):
    """It stops only because this robot does so by itself."""

    def stop(self):
        pass


class ArmsWithoutSuccess(Manager):
    def arm(self, request, response):
        super().arm(request, response)
        response.success = False
        return response


class StandsAfterTheReset(Manager):
    was_reset = False

    def reset(self, request, response):
        self.was_reset = True
        return super().reset(request, response)

    def drive(self):
        if not self.was_reset:
            return super().drive()
        self.publisher.publish(Twist())
