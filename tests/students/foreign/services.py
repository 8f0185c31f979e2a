"""Services, actions, parameters and lifecycles in other ways."""

import contextlib
import threading

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts, Trigger
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.exceptions import InvalidParameterValueException
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from std_msgs.msg import Float64, String


class Adds(Node):
    def __init__(self):
        super().__init__("adds")
        self.create_service(AddTwoInts, "add", self.add)

    async def add(self, request, response):
        response.sum = request.a + request.b
        return response


class AwaitsAnother(Node):
    """A service that awaits another one, in a group that lets it."""

    def __init__(self):
        super().__init__("awaits")
        self.group = ReentrantCallbackGroup()
        self.client = self.create_client(AddTwoInts, "add", callback_group=self.group)
        self.create_service(Trigger, "triple", self.triple, callback_group=self.group)

    async def triple(self, request, response):
        found = await self.client.call_async(AddTwoInts.Request(a=1, b=2))
        response.success, response.message = True, str(found.sum)
        return response


class CallsBack(Node):
    """Sends its request when the service is there; until then each tick looks again."""

    def __init__(self):
        super().__init__("calls")
        self.client = self.create_client(Trigger, "triple")
        self.timer = self.create_timer(0.2, self.look)

    def look(self):
        if self.client.service_is_ready():
            self.timer.cancel()
            self.client.call_async(Trigger.Request()).add_done_callback(self.answered)

    def answered(self, future):
        self.get_logger().info(future.result().message)


def calls_in_a_script():
    """A blocking call, beside a thread that spins."""
    rclpy.init()
    node = rclpy.create_node("script")
    threading.Thread(target=spin, args=(node,), daemon=True).start()
    client = node.create_client(AddTwoInts, "add")
    if client.wait_for_service(timeout_sec=2.0):
        print(client.call(AddTwoInts.Request(a=2, b=3)).sum)
    node.destroy_node()
    rclpy.shutdown()


def spin(node):
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


def gives_up_waiting():
    """Its service is not there, which it says; then it ends."""
    rclpy.init()
    node = rclpy.create_node("gives_up")
    client = node.create_client(Trigger, "reset_all")
    while not client.wait_for_service(timeout_sec=0.5):
        node.get_logger().info("no service yet")
        if node.get_clock().now().nanoseconds % 10**9 >= 5 * 10**8:
            break
    node.destroy_node()
    rclpy.shutdown()


class Counts(Node):
    """An action whose goals may be refused and canceled."""

    def __init__(self):
        super().__init__("counts")
        self.server = ActionServer(
            self,
            Fibonacci,
            "count",
            execute_callback=self.execute,
            goal_callback=lambda goal: GoalResponse.ACCEPT if goal.order > 0 else GoalResponse.REJECT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def execute(self, handle):
        rate = self.create_rate(10)
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        for _ in range(handle.request.order):
            if handle.is_cancel_requested:
                handle.canceled()
                return Fibonacci.Result(sequence=feedback.sequence)
            feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
            handle.publish_feedback(feedback)
            rate.sleep()
        handle.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


def counts():
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Counts(), MultiThreadedExecutor())


class WantsCounts(Node):
    """A chain of callbacks, and a second goal that it cancels."""

    def __init__(self):
        super().__init__("wants")
        self.client = ActionClient(self, Fibonacci, "count")
        self.timer = self.create_timer(0.1, self.send)

    def send(self):
        if self.client.server_is_ready():
            self.timer.cancel()
            self.client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(self.accepted)

    def accepted(self, future):
        future.result().get_result_async().add_done_callback(self.first_is_done)

    def first_is_done(self, future):
        goal = self.client.send_goal_async(Fibonacci.Goal(order=50), feedback_callback=lambda _: None)
        goal.add_done_callback(lambda it: it.result().cancel_goal_async())


class Tunable(Node):
    """Parameters with limits, groups, and a callback that refuses values."""

    def __init__(self):
        super().__init__("tunable")
        limits = ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=1.0)])
        self.declare_parameter("gain", 0.5, limits)
        self.declare_parameters("wheel", [("radius", 0.1), ("names", ["left", "right"])])
        self.add_on_set_parameters_callback(self.check)
        self.publisher = self.create_publisher(Float64, "gain", 10)
        self.create_timer(0.5, self.tick)

    def check(self, parameters):
        right = all(each.name != "wheel.radius" or each.value > 0.0 for each in parameters)
        return SetParametersResult(successful=right, reason="" if right else "a radius is positive")

    def tick(self):
        self.publisher.publish(Float64(data=self.get_parameter("gain").value))


class Tunes(Node):
    """Sets another node's parameter, and its own."""

    def __init__(self):
        super().__init__("tunes", allow_undeclared_parameters=True)
        self.set_parameters([Parameter("mode", value="fast")])
        self.client = AsyncParameterClient(self, "tunable")
        self.timer = self.create_timer(0.3, self.tune)

    def tune(self):
        if self.client.services_are_ready():
            self.timer.cancel()
            self.client.set_parameters([Parameter("gain", value=0.8)])


class DoesWithoutItsStart(Node):
    """Refuses the value that it is started with, and goes on with its default."""

    def __init__(self):
        super().__init__("cautious", parameter_overrides=[Parameter("speed", value=9.0)])
        self.speed = 0.1
        self.add_on_set_parameters_callback(self.check)
        try:
            self.declare_parameters("limits", [("acceleration", 0.5)])
            self.declare_parameter("speed", self.speed)
        except InvalidParameterValueException as error:
            self.get_logger().warning(str(error))
        self.create_timer(0.5, lambda: self.get_logger().info(f"{self.speed} m/s"))

    def check(self, parameters):
        fast = any(one.name == "speed" and one.value > 1.0 for one in parameters)
        return SetParametersResult(successful=not fast, reason="too fast" if fast else "")


class Lamp(LifecycleNode):
    """Publishes only while it is active."""

    def on_configure(self, state):
        self.publisher = self.create_lifecycle_publisher(String, "light", 10)
        self.timer = self.create_timer(0.1, lambda: self.publisher.publish(String(data="on")))
        return TransitionCallbackReturn.SUCCESS


def lamp():
    rclpy.init()
    spin(Lamp("lamp"))


class Manages(Node):
    """Brings the lamp to active, one transition after the other."""

    def __init__(self):
        super().__init__("manager")
        self.client = self.create_client(ChangeState, "lamp/change_state")
        self.steps = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]
        self.create_subscription(String, "light", lambda _: None, 10)
        self.timer = self.create_timer(0.2, self.step)

    def step(self):
        if not self.steps:
            self.timer.cancel()
        elif self.client.service_is_ready():
            self.client.call_async(ChangeState.Request(transition=Transition(id=self.steps.pop(0))))


CORPUS = [
    (Adds, AwaitsAnother, CallsBack),
    (Adds, calls_in_a_script),
    (gives_up_waiting,),
    (counts, WantsCounts),
    (Tunable, Tunes),
    (DoesWithoutItsStart,),
    (lamp, Manages),
]
