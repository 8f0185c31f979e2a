"""Nodes that publish only later, or elsewhere than in their timer, and do so in no run that is short."""

from example_interfaces.srv import Trigger
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener


class Flushes:
    """Collects lines, and publishes those that there are."""

    def __init__(self, node):
        self.publisher, self.lines = node.create_publisher(String, "events", 10), []

    def flush(self):
        for line in self.lines:
            self.publisher.publish(String(data=line))
        self.lines.clear()


class HasAHelper(Node):
    """The callback is a method of another object."""

    def __init__(self):
        super().__init__("has_a_helper")
        self.events = Flushes(self)
        self.create_timer(0.3, self.events.flush)


class Collects(Node):
    """Publishes later what has come until then."""

    def __init__(self):
        super().__init__("collects")
        self.lines = []
        self.publisher = self.create_publisher(String, "events", 10)
        self.create_subscription(String, "lines", self.take, 10)
        self.create_timer(0.3, self.flush)

    def take(self, message):
        self.lines.append(message.data)

    def flush(self):
        while self.lines:
            self.publisher.publish(String(data=self.lines.pop(0)))


class PublishesOnRequest(Node):
    """Its timer only logs; a service publishes."""

    def __init__(self):
        super().__init__("on_request")
        self.publisher = self.create_publisher(String, "events", 10)
        self.create_timer(0.5, self.report)
        self.create_service(Trigger, "~/send", self.send)

    def report(self):
        self.get_logger().debug("alive")

    def send(self, request, response):
        self.publisher.publish(String(data="requested"))
        response.success = True
        return response


class Averages(Node):
    """Publishes the mean of a hundred values, and a few come."""

    def __init__(self):
        super().__init__("averages")
        self.values = []
        self.publisher = self.create_publisher(String, "mean", 10)
        self.create_subscription(LaserScan, "/scan", self.take, 10)

    def take(self, message):
        self.values.append(min(message.ranges))
        if len(self.values) >= 100:
            self.publisher.publish(String(data=str(sum(self.values) / 100)))
            self.values.clear()


class WaitsForFrames(Node):
    """Publishes a transform as soon as it is known, which it never is."""

    def __init__(self):
        super().__init__("waits_for_frames")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(TransformStamped, "tip", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        if self.buffer.can_transform("map", "tip", Time()):
            self.publisher.publish(self.buffer.lookup_transform("map", "tip", Time()))


class CatchesWhatIsMissing(WaitsForFrames):
    """The same, with an exception."""

    def tick(self):
        try:
            found = self.buffer.lookup_transform("map", "tip", Time())
        except TransformException:
            return
        self.publisher.publish(found)


class Slow(Node):
    """Publishes every two seconds, which is what it should."""

    def __init__(self):
        super().__init__("slow")
        self.publisher = self.create_publisher(String, "events", 10)
        self.create_timer(2.0, lambda: self.publisher.publish(String(data="slow")))


CORPUS = [
    (HasAHelper,),
    (Collects,),
    (Slow,),
    (PublishesOnRequest,),
    (Averages,),
    (WaitsForFrames,),
    (CatchesWhatIsMissing,),
]
