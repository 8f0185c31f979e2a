"""Nodes that publish only when something comes, which doesn't come in a run alone."""

import rclpy
from example_interfaces.srv import SetBool, Trigger
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Empty, String


class Switched(Node):
    """A service switches it on."""

    def __init__(self):
        super().__init__("switched")
        self.on = False
        self.publisher = self.create_publisher(String, "light", 10)
        self.create_service(SetBool, "switch", self.switch)
        self.create_timer(0.2, self.tick)

    def switch(self, request, response):
        self.on = request.data
        response.success = True
        return response

    def tick(self):
        if self.on:
            self.publisher.publish(String(data="on"))


class Started(Node):
    """A message starts it."""

    def __init__(self):
        super().__init__("started")
        self.on = False
        self.publisher = self.create_publisher(String, "light", 10)
        self.create_subscription(Empty, "start", self.start, 10)
        self.create_timer(0.2, self.tick)

    def start(self, message):
        self.on = True

    def tick(self):
        if not self.on:
            return
        self.publisher.publish(String(data="on"))


class NeedsBoth(Node):
    """Publishes when it has two inputs; one of them is there."""

    def __init__(self):
        super().__init__("needs_both")
        self.scan = self.text = None
        self.publisher = self.create_publisher(String, "both", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, 10)
        self.create_subscription(String, "/text", self.on_text, 10)

    def on_scan(self, message):
        self.scan = message
        self.combine()

    def on_text(self, message):
        self.text = message
        self.combine()

    def combine(self):
        if self.scan is not None and self.text is not None:
            self.publisher.publish(self.text)


class Enabled(Node):
    """A parameter enables it."""

    def __init__(self):
        super().__init__("enabled")
        self.declare_parameter("enabled", False)
        self.publisher = self.create_publisher(String, "light", 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        if self.get_parameter("enabled").value:
            self.publisher.publish(String(data="on"))


class Bumper(Node):
    """Publishes the moment at which something comes near."""

    def __init__(self):
        super().__init__("bumper")
        self.was_near = False
        self.publisher = self.create_publisher(String, "bump", 10)
        self.create_subscription(LaserScan, "/scan", self.scan, 10)

    def scan(self, message):
        near = any(each < 0.1 for each in message.ranges)
        if near and not self.was_near:
            self.publisher.publish(String(data="bump"))
        self.was_near = near


class Debugs(Node):
    """An output for debugging, which is off."""

    debug = False

    def __init__(self):
        super().__init__("debugs")
        self.publisher = self.create_publisher(String, "light", 10)
        self.details = self.create_publisher(String, "~/details", 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        self.publisher.publish(String(data="on"))
        if self.debug:
            self.details.publish(String(data="details"))


class SendsAGoal(Node):
    """Sends one message, to the first who subscribes."""

    def __init__(self):
        super().__init__("sends_a_goal")
        self.publisher = self.create_publisher(PoseStamped, "goal_pose", 1)
        self.timer = self.create_timer(0.4, self.tick)

    def tick(self):
        if self.publisher.get_subscription_count():
            self.publisher.publish(PoseStamped())
            self.timer.cancel()


def says_it_once():
    """Waits for a subscription, publishes once, and ends."""
    rclpy.init()
    node = rclpy.create_node("once")
    publisher = node.create_publisher(String, "hello", 10)
    while publisher.get_subscription_count() == 0 and rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
    publisher.publish(String(data="hello"))
    rclpy.spin_once(node, timeout_sec=0.5)
    node.destroy_node()
    rclpy.shutdown()


class TakesHello(Node):
    def __init__(self):
        super().__init__("takes_hello")
        self.create_subscription(String, "hello", self.take, 10)

    def take(self, message):
        self.get_logger().info(message.data)


class OffersStop(Node):
    def __init__(self):
        super().__init__("stops")
        self.create_service(Trigger, "/robot/stop", self.stop)

    def stop(self, request, response):
        response.success = True
        return response


class WantsStart(Node):
    """Calls a service if it is there; another one of the same type is."""

    def __init__(self):
        super().__init__("starts")
        self.client = self.create_client(Trigger, "/robot/start")
        self.create_timer(0.5, self.tick)

    def tick(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


CORPUS = [
    (Switched,),
    (Started,),
    (NeedsBoth,),
    (Enabled,),
    (Bumper,),
    (Debugs,),
    (SendsAGoal,),
    (says_it_once, TakesHello),
    (TakesHello, says_it_once),
    (OffersStop, WantsStart),
]
