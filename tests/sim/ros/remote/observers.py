"""Nodes that look around in the ROS graph, and nodes for topics with settings of their own."""

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import ParameterEvent
from rclpy.action import ActionClient
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from std_msgs.msg import String
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class Observer(Node):
    """Logs twice a second what there is."""

    def __init__(self):
        super().__init__("observer")
        self.adder = self.create_client(AddTwoInts, "add")
        self.fibonacci = ActionClient(self, Fibonacci, "fibonacci")
        self.out = self.create_publisher(String, "chat", 10)
        self.create_timer(0.5, self.look)

    def look(self):
        ends = self.get_publishers_info_by_topic("/odom"), self.get_subscriptions_info_by_topic("/cmd_vel")
        seen = [
            sorted(set(self.get_node_names()) - {"run"}),
            sorted(self.get_topic_names_and_types()),
            sorted(self.get_service_names_and_types()),
            [self.count_publishers(topic) for topic in ("/odom", "/scan", "/nothing", "/chat")],
            [self.count_subscribers(topic) for topic in ("/cmd_vel", "/odom", "/chat")],
            [
                (end.node_name, end.topic_type, end.qos_profile.reliability.name)
                for part in ends
                for end in part
            ],
            [self.adder.service_is_ready(), self.fibonacci.server_is_ready()],
            self.out.get_subscription_count(),
        ]
        for line in seen:
            self.get_logger().info(f"{line}")


class LateTalker(Node):
    """Makes a latched publisher after a second, says three words at once, and is silent."""

    def __init__(self):
        super().__init__("late_talker")
        self.timer = self.create_timer(1.0, self.talk)

    def talk(self):
        self.timer.cancel()
        self.out = self.create_publisher(String, "chat", LATCHED)
        for word in ("one", "two", "three"):
            self.out.publish(String(data=word))


class Counter(Node):
    """Makes a publisher after half a second, and publishes as soon as it counts a subscription."""

    def __init__(self):
        super().__init__("counter")
        self.out = None
        self.create_timer(0.5, self.count)

    def count(self):
        self.out = self.out or self.create_publisher(String, "words", 10)
        count = self.out.get_subscription_count()
        self.get_logger().info(f"{count}")
        if count:
            self.out.publish(String(data="a word"))


class Counted(Node):
    """Logs what it receives; from 1.75 s on with a second subscription."""

    def __init__(self):
        super().__init__("counted")
        self.listen()
        self.timer = self.create_timer(1.75, self.listen_more)

    def listen(self):
        self.create_subscription(String, "words", lambda word: self.get_logger().info(word.data), 10)

    def listen_more(self):
        self.timer.cancel()
        self.listen()


class LateListener(Node):
    """Listens from 2 s to 3 s to what was latched, and then again; and says what it receives."""

    def __init__(self):
        super().__init__("late_listener")
        self.create_timer(1.0, self.change)
        self.ticks, self.subscription = 0, None

    def change(self):
        self.ticks += 1
        if self.subscription is not None:
            self.destroy_subscription(self.subscription)
            self.subscription = None
        elif self.ticks > 1:
            self.subscription = self.create_subscription(String, "chat", self.on_message, LATCHED)

    def on_message(self, msg):
        self.get_logger().info(msg.data)


class PickyListener(Node):
    """Wants what is latched and reliable, and says so when it can't have it."""

    def __init__(self):
        super().__init__("picky_listener")
        events = SubscriptionEventCallbacks(incompatible_qos=lambda event: self.complain(event))
        self.create_subscription(String, "chat", self.complain, LATCHED, event_callbacks=events)

    def complain(self, what):
        self.get_logger().info(f"{type(what).__name__} {getattr(what, 'total_count', '')}")


class SloppyTalker(Node):
    """Says its word five times a second, as it comes."""

    def __init__(self):
        super().__init__("sloppy_talker")
        events = PublisherEventCallbacks(
            incompatible_qos=lambda event: self.get_logger().info("no one can receive")
        )
        self.out = self.create_publisher(String, "chat", BEST_EFFORT, event_callbacks=events)
        self.create_timer(0.2, lambda: self.out.publish(String(data="word")))


class Burst(Node):
    """Says twenty words at once, every second."""

    def __init__(self):
        super().__init__("burst")
        self.out = self.create_publisher(String, "chat", 20)
        self.create_timer(1.0, self.talk)

    def talk(self):
        for number in range(20):
            self.out.publish(String(data=f"{number}"))


class ShortListener(Node):
    """Has room for three, and answers what it receives."""

    def __init__(self):
        super().__init__("short_listener")
        self.out = self.create_publisher(String, "answer", 10)
        self.create_subscription(String, "chat", lambda msg: self.out.publish(msg), 3)
        self.create_subscription(String, "chat", lambda msg: None, qos_profile_sensor_data)


class Setter(Node):
    """Has a parameter, and sets it."""

    def __init__(self):
        super().__init__("setter")
        self.declare_parameter("speed", 1.0)
        self.create_timer(1.0, lambda: self.set_parameters([Parameter("speed", value=2.0)]))


class Gossip(Node):
    """Listens to ROS's own topics."""

    def __init__(self):
        super().__init__("gossip")
        self.create_subscription(ParameterEvent, "/parameter_events", self.on_message, 10)

    def on_message(self, event):
        changed = [parameter.name for parameter in event.changed_parameters]
        self.get_logger().info(f"{event.node} {changed}")


class OtherService(Node):
    """Offers what another node offers, with another type."""

    def __init__(self):
        super().__init__("other")
        self.create_service(Trigger, "add", lambda request, response: response)


class OtherClient(Node):
    """Asks for what another node offers, with another type."""

    def __init__(self):
        super().__init__("other")
        self.create_client(Trigger, "add")


class LateOtherService(Node):
    """As `OtherService`, a second later."""

    def __init__(self):
        super().__init__("other")
        self.create_timer(1.0, self.offer)

    def offer(self):
        self.create_service(Trigger, "add", lambda request, response: response)


class NoName(Node):
    """Offers a service whose name is none."""

    def __init__(self):
        super().__init__("other")
        self.create_service(Trigger, "add two", lambda request, response: response)
