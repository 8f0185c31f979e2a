"""Waitables of one's own, as a library on rclpy writes them; and an action offered with plain services."""

import rclpy
from action_msgs.srv import CancelGoal
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_services_default
from rclpy.task import Future
from rclpy.type_support import check_for_type_support
from rclpy.waitable import NumberOfEntities, Waitable
from std_srvs.srv import Trigger

IMPL = Fibonacci.Impl


class Bell(Waitable):
    """Becomes ready when someone rings."""

    def __init__(self, node):
        super().__init__(MutuallyExclusiveCallbackGroup())
        self.node, self.rang = node, False
        self.guard = GuardCondition(None, None, context=node.context)

    def __enter__(self):
        self.guard.handle.__enter__()

    def __exit__(self, *error):
        self.guard.handle.__exit__(*error)

    def is_ready(self, wait_set):
        return wait_set.is_ready("guard_condition", self.index)

    def take_data(self):
        return "ding"

    async def execute(self, data):
        self.node.get_logger().info(data)

    def get_num_entities(self):
        return NumberOfEntities(num_gcs=1)

    def add_to_wait_set(self, wait_set):
        self.index = wait_set.add_guard_condition(self.guard.handle)


class Ringer(Node):
    """Rings each half second; once it rings twice at once, which is one ring."""

    def __init__(self):
        super().__init__("ringer")
        self.bell = Bell(self)
        self.add_waitable(self.bell)
        self.create_timer(0.5, self.ring)

    def ring(self):
        self.bell.guard.trigger()
        self.bell.guard.trigger()


class Counter(Waitable):
    """A service in a waitable, answered with what take_data() gives."""

    def __init__(self, node):
        super().__init__(node.default_callback_group)
        self.node, self.asked = node, 0
        check_for_type_support(Trigger)
        with node.handle:
            profile = qos_profile_services_default.get_c_qos_profile()
            self.service = _rclpy.Service(node.handle, Trigger, "count", profile)

    def __enter__(self):
        self.service.__enter__()

    def __exit__(self, *error):
        self.service.__exit__(*error)

    def is_ready(self, wait_set):
        return wait_set.is_ready("service", self.index)

    def take_data(self):
        return self.service.service_take_request(Trigger.Request)

    async def execute(self, data):
        self.asked += 1
        response = Trigger.Response(success=True, message=f"asked {self.asked} times")
        self.service.service_send_response(response, data[1].request_id)

    def get_num_entities(self):
        return NumberOfEntities(num_services=1)

    def add_to_wait_set(self, wait_set):
        self.index = wait_set.add_service(self.service)


class Counting(Node):
    def __init__(self):
        super().__init__("counting")
        self.add_waitable(Counter(self))


class Asker(Node):
    def __init__(self):
        super().__init__("asker")
        self.client = self.create_client(Trigger, "count")
        self.create_timer(0.5, self.ask)

    def ask(self):
        answer = self.client.call_async(Trigger.Request())
        answer.add_done_callback(lambda done: self.get_logger().info(done.result().message))


class Caller(Waitable):
    """A client in a waitable, made past create_client()."""

    def __init__(self, node):
        super().__init__(node.default_callback_group)
        self.node = node
        check_for_type_support(Trigger)
        with node.handle:
            profile = qos_profile_services_default.get_c_qos_profile()
            self.client = _rclpy.Client(node.handle, Trigger, "count", profile)

    def __enter__(self):
        self.client.__enter__()

    def __exit__(self, *error):
        self.client.__exit__(*error)

    def is_ready(self, wait_set):
        return wait_set.is_ready("client", self.index)

    def take_data(self):
        return self.client.take_response(Trigger.Response)[1]

    async def execute(self, data):
        self.node.get_logger().info(data.message)

    def get_num_entities(self):
        return NumberOfEntities(num_clients=1)

    def add_to_wait_set(self, wait_set):
        self.index = wait_set.add_client(self.client)


class Calling(Node):
    def __init__(self):
        super().__init__("calling")
        caller = Caller(self)
        self.add_waitable(caller)
        self.create_service(Trigger, "count", self.answer)
        self.create_timer(0.5, lambda: caller.client.send_request(Trigger.Request()))

    def answer(self, request, response):
        response.message = "asked"
        return response


class Ticker(Waitable):
    """A timer in a waitable, on the machine's clock."""

    def __init__(self, node):
        super().__init__(node.default_callback_group)
        clock = Clock()
        self.timer = _rclpy.Timer(clock.handle, node.context.handle, 10**8, True)

    def get_num_entities(self):
        return NumberOfEntities(num_timers=1)


class Ticking(Node):
    def __init__(self):
        super().__init__("ticking")
        self.add_waitable(Ticker(self))


class ByHand(Node):
    """Offers the action fibonacci with three services and a publisher."""

    def __init__(self):
        super().__init__("by_hand")
        self.create_service(IMPL.SendGoalService, "fibonacci/_action/send_goal", self.accept)
        self.create_service(CancelGoal, "fibonacci/_action/cancel_goal", self.cancel)
        self.create_service(IMPL.GetResultService, "fibonacci/_action/get_result", self.give)
        self.publisher = self.create_publisher(IMPL.FeedbackMessage, "fibonacci/_action/feedback", 10)
        self.create_timer(0.5, self.tell)
        self.goal, self.begin = None, self.get_clock().now()

    def accept(self, request, response):
        self.goal = request.goal_id
        self.get_logger().info(f"order {request.goal.order}")
        self.tell()  # before the response
        response.accepted = True
        return response

    def tell(self):
        if self.goal is not None:
            tenths = (self.get_clock().now() - self.begin).nanoseconds // 10**8
            feedback = Fibonacci.Feedback(sequence=[tenths])
            self.publisher.publish(IMPL.FeedbackMessage(goal_id=self.goal, feedback=feedback))

    def cancel(self, request, response):
        response.goals_canceling = [request.goal_info]
        return response

    def give(self, request, response):
        response.result.sequence = [1, 2, 3]
        return response


class Client(Node):
    """Sends a goal at 0.75 s, listens to it, cancels it at 1.75 s, and asks for its result."""

    def __init__(self):
        super().__init__("client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.timer = self.create_timer(0.75, self.send)

    def send(self):
        self.timer.cancel()
        sent = self.client.send_goal_async(Fibonacci.Goal(order=5), feedback_callback=self.on_message)
        sent.add_done_callback(self.sent)

    def sent(self, done: Future):
        self.goal = done.result()
        self.get_logger().info(f"accepted {self.goal.accepted}")
        self.timer = self.create_timer(1.0, self.stop)

    def on_message(self, message):
        self.get_logger().info(f"feedback {list(message.feedback.sequence)}")

    def stop(self):
        self.timer.cancel()
        canceled = self.goal.cancel_goal_async()
        canceled.add_done_callback(lambda done: self.say(f"canceling {len(done.result().goals_canceling)}"))
        got = self.goal.get_result_async()
        got.add_done_callback(lambda done: self.say(f"result {list(done.result().result.sequence)}"))

    def say(self, text):
        self.get_logger().info(text)


def by_hand_and_client():
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in (ByHand(), Client()):
        executor.add_node(node)
    executor.spin()


class Flag(Waitable):
    """Has nothing that a wait set could wait for: it is looked at whenever the executor wakes."""

    def __init__(self, group):
        super().__init__(group)
        self.raised = False

    def get_num_entities(self):
        return NumberOfEntities()

    def add_to_wait_set(self, wait_set):
        pass

    def is_ready(self, wait_set):
        return self.raised

    def take_data(self):
        self.raised = False

    async def execute(self, taken):
        rclpy.logging.get_logger("flag").info("seen")


def raises_a_flag():
    rclpy.init()
    node = Node("raiser")
    flag = Flag(node.default_callback_group)
    node.add_waitable(flag)
    node.create_timer(0.5, lambda: setattr(flag, "raised", True))
    rclpy.spin(node)
