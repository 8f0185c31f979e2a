"""Publishers and subscriptions of all kinds that do or don't receive each other."""

from itertools import product

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_profile_best_available,
    qos_profile_sensor_data,
    qos_profile_system_default,
)
from std_msgs.msg import String

KINDS = [
    *(
        QoSProfile(depth=2, reliability=reliability, durability=durability)
        for reliability in (ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT)
        for durability in (DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE)
    ),
    QoSProfile(history=HistoryPolicy.KEEP_ALL, durability=DurabilityPolicy.TRANSIENT_LOCAL),
    qos_profile_system_default,
    qos_profile_best_available,
    qos_profile_sensor_data,
]


class EveryProfile(Node):
    """Speaks with every QoS profile, and listens with every other one: from the start, and late."""

    def __init__(self):
        super().__init__("every_profile")
        self.pairs = [(f"chat_{number}", *pair) for number, pair in enumerate(product(KINDS, KINDS))]
        for topic, _, profile in self.pairs:
            self.listen(topic, "early", profile)
        self.outs = [self.create_publisher(String, topic, profile) for topic, profile, _ in self.pairs]
        self.timer = self.create_timer(1.0, self.speak)

    def listen(self, topic, who, profile):
        def on_message(message, information):
            self.get_logger().info(f"{who} on {topic}: {message.data}, {information}")

        self.create_subscription(String, topic, on_message, profile)

    def speak(self):
        for out in self.outs:
            for number in range(3):
                out.publish(String(data=f"word {number}"))
        for topic, _, profile in self.pairs:
            self.listen(topic, "late", profile)
        self.timer.cancel()
        for out in self.outs:
            out.publish(String(data="last word"))


class ForgetsEnds(Node):
    """Destroys a latched publisher before someone comes who would receive it, and a subscription."""

    def __init__(self):
        super().__init__("forgets_ends")
        self.latched = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.out = self.create_publisher(String, "chat", self.latched)
        self.other = self.create_publisher(String, "chat", self.latched)
        self.listener = self.create_subscription(String, "chat", self.on_message, 10)
        self.create_timer(0.5, self.step)
        self.steps = 0

    def on_message(self, message):
        self.get_logger().info(message.data)

    def step(self):
        self.steps += 1
        if self.steps == 1:
            self.out.publish(String(data="of the one that goes"))
            self.other.publish(String(data="of the one that stays"))
        elif self.steps == 2:
            self.other.publish(String(data="to no one"))
            self.destroy_subscription(self.listener)
            self.destroy_publisher(self.out)
        elif self.steps == 3:
            self.create_subscription(String, "chat", self.on_message, self.latched)


class Garbage(Node):
    """Sends bytes that are no message, and then one that is."""

    def __init__(self):
        super().__init__("garbage")
        self.out = self.create_publisher(String, "chat", 10)
        self.create_subscription(String, "chat", self.on_message, 10)
        self.create_timer(1.0, self.speak)

    def on_message(self, message):
        self.get_logger().info(message.data)

    def speak(self):
        self.out.publish(b"no message")
        self.out.publish(String(data="a message"))


class SpeaksAfterItsEnd(Node):
    """Publishes with a publisher that it has destroyed."""

    def __init__(self):
        super().__init__("speaks_after_its_end")
        out = self.create_publisher(String, "chat", 10)
        self.destroy_publisher(out)
        out.publish(String(data="too late"))


class SaysItAtOnce(Node):
    """Publishes as soon as it has a publisher: in its constructor, and with a new publisher at each tick."""

    profile = QoSProfile(depth=10)

    def __init__(self):
        super().__init__("hasty")
        self.say("in __init__", "words")
        self.create_timer(1.0, lambda: self.say("in a new one", "more_words"))
        publisher = self.create_publisher(String, "words", self.profile)
        self.create_timer(1.0, lambda: publisher.publish(String(data="from a timer")))

    def say(self, text, topic):
        self.create_publisher(String, topic, self.profile).publish(String(data=text))


class SaysItAtOnceAndLatches(SaysItAtOnce):
    profile = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Receives(Node):
    """Logs what is said on both topics."""

    profile = QoSProfile(depth=10)

    def __init__(self):
        super().__init__("receives")
        for topic in ("words", "more_words"):
            self.create_subscription(String, topic, self.on_message, self.profile)

    def on_message(self, message):
        self.get_logger().info(message.data)


class ReceivesWhatIsLatched(Receives):
    profile = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def both_in_one_program():
    rclpy.init()
    executor = SingleThreadedExecutor()
    for node in (Receives(), SaysItAtOnce()):
        executor.add_node(node)
    executor.spin()


class LateListener(Node):
    """Begins to listen at 1 s."""

    def __init__(self):
        super().__init__("late")
        self.timer = self.create_timer(1.0, self.listen)

    def listen(self):
        self.timer.cancel()
        self.create_subscription(String, "words", lambda message: self.get_logger().info(message.data), 10)
