"""Other programs of lesson 15: sensors, a client that cancels too late, one that tries again."""

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Time
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import PointStamped, PoseStamped
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger

STATUS = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "canceled"}

# -- Two sensors with equal stamps -------------------------------------------------------------------


def measured(x, stamp=None):
    """The pose of a robot at x (m), and a person at x = 5 as the robot sees them."""
    pose, person = PoseStamped(), PointStamped()
    for msg in (pose, person):
        msg.header.stamp = stamp or Time(sec=int(x))
    pose.pose.position.x, person.point.x = x, 5.0 - x
    return pose, person


class Sensors(Node):
    """Publishes the pose and where the person is, ten times a second, with one stamp."""

    def __init__(self):
        super().__init__("sensors")
        self.x = 0.0
        self.pose = self.create_publisher(PoseStamped, "/pose", 10)
        self.person = self.create_publisher(PointStamped, "/person", 10)
        self.create_timer(0.1, self.measure)

    def measure(self):
        """Drive 10 cm, and publish both."""
        self.x += 0.1
        pose, person = measured(self.x, self.get_clock().now().to_msg())
        self.pose.publish(pose)
        self.person.publish(person)


# -- A cancel that crosses a success ------------------------------------------------------------------


class Errand(Node):
    """An action server: each goal of /errand succeeds after 1 s, unless it is canceled before."""

    def __init__(self):
        super().__init__("errand")
        options = {"callback_group": ReentrantCallbackGroup(), "cancel_callback": self.on_cancel}
        self.server = ActionServer(self, Fibonacci, "/errand", self.execute, **options)

    def on_cancel(self, goal):
        """Accept each request to cancel."""
        return CancelResponse.ACCEPT

    async def execute(self, goal):
        """Wait a second, and succeed."""
        done = Future()
        timer = self.create_timer(1.0, lambda: done.set_result(None))
        await done
        timer.destroy()
        goal.succeed()
        return Fibonacci.Result()


class Impatient(Node):
    """Sends a goal, and cancels it at the moment at which it succeeds."""

    def __init__(self):
        super().__init__("impatient")
        self.group, self.goal = ReentrantCallbackGroup(), None
        self.client = ActionClient(self, Fibonacci, "/errand", callback_group=self.group)
        self.begin_timer = self.create_timer(0.1, self.begin, callback_group=self.group)

    async def begin(self):
        """Send one goal, once the server is there."""
        if not self.client.server_is_ready():
            return
        self.begin_timer.cancel()
        self.goal = await self.client.send_goal_async(Fibonacci.Goal())
        self.cancel_timer = self.create_timer(1.0, self.cancel, callback_group=self.group)
        result = await self.goal.get_result_async()
        self.get_logger().info(f"status of the result: {STATUS[result.status]}")

    async def cancel(self):
        """Request to cancel it, once."""
        self.cancel_timer.cancel()
        self.get_logger().info("I cancel the goal")
        answer = await self.goal.cancel_goal_async()
        self.get_logger().info(f"goals that are being canceled: {len(answer.goals_canceling)}")


# -- For lesson 15b ----------------------------------------------------------------------------------


class Dispatcher(Node):
    """Calls /plan once, 1.8 s after the start."""

    def __init__(self):
        super().__init__("dispatcher")
        self.client = self.create_client(Trigger, "/plan")
        self.timer = self.create_timer(1.8, self.request)

    def request(self):
        """Request a plan."""
        self.timer.cancel()
        self.client.call_async(Trigger.Request())


class Orders(Node):
    """Requests one parcel on /give (order 7); without a response for 0.5 s it tries again, up to 3 times."""

    def __init__(self):
        super().__init__("orders")
        self.client = self.create_client(AddTwoInts, "/give")
        self.tries, self.answered = 0, False
        self.timer = self.create_timer(0.5, self.order)

    def order(self):
        """Send the request, unless there is a response; after three tries, give up."""
        if self.answered or self.tries == 3:
            self.timer.cancel()
        elif self.client.service_is_ready():
            self.tries += 1
            self.get_logger().info(f"order 7, try {self.tries}")
            self.client.call_async(AddTwoInts.Request(a=7, b=1)).add_done_callback(self.on_response)

    def on_response(self, future):
        """The order has been carried out."""
        self.answered = True
