"""Listeners to three topics: right ones, and wrong ones named by their defect."""

from functools import partial

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, Float64, String

TYPES = {"/chatter0": String, "/chatter1": Float64, "/chatter2": Bool}


class Listener(Node):
    """As one would write it."""

    def __init__(self):
        super().__init__("chatter_listener")
        for topic, kind in TYPES.items():
            self.create_subscription(kind, topic, partial(self.on_message, topic=topic), 10)

    def on_message(self, msg, topic):
        self.get_logger().info(f"{topic}: {msg.data}")


class ListenerWithLambdas(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        self.create_subscription(String, "chatter0", lambda msg: self.on_message(msg, "chatter0"), 10)
        self.create_subscription(Float64, "chatter1", lambda msg: self.on_message(msg, "chatter1"), 10)
        self.create_subscription(Bool, "chatter2", lambda msg: self.on_message(msg, "chatter2"), 10)


class ListenerWithDefaultArgument(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic, kind in TYPES.items():
            self.create_subscription(kind, topic, lambda msg, name=topic: self.on_message(msg, name), 10)


def main_with_function_that_makes_callbacks():
    rclpy.init()
    node = Node("chatter_listener")

    def listener_to(topic):
        def on_message(msg):
            node.get_logger().info(f"I heard {topic}: {msg.data}!")

        return on_message

    for topic, kind in TYPES.items():
        node.create_subscription(kind, topic, listener_to(topic), 10)
    rclpy.spin(node)


class ListenerThatKnowsByType(Listener):
    """The three types differ, so the type tells the topic."""

    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic, kind in TYPES.items():
            self.create_subscription(kind, topic, self.sort, 10)

    def sort(self, msg):
        self.on_message(msg, {String: "/chatter0", Float64: "/chatter1", Bool: "/chatter2"}[type(msg)])


class LambdaInLoop(Listener):
    """Each lambda looks at `topic` when it is called, and then the loop is over."""

    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic, kind in TYPES.items():
            self.create_subscription(kind, topic, lambda msg: self.on_message(msg, topic), 10)  # noqa: B023


class ThreeCallbacks(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        self.create_subscription(String, "/chatter0", self.on_word, 10)
        self.create_subscription(Float64, "/chatter1", self.on_number, 10)
        self.create_subscription(Bool, "/chatter2", self.on_answer, 10)

    def on_word(self, msg):
        self.on_message(msg, "/chatter0")

    def on_number(self, msg):
        self.on_message(msg, "/chatter1")

    def on_answer(self, msg):
        self.on_message(msg, "/chatter2")


class OnlyTwoTopics(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic in ("/chatter0", "/chatter1"):
            self.create_subscription(TYPES[topic], topic, partial(self.on_message, topic=topic), 10)


class AllOfOneType(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic in TYPES:
            self.create_subscription(String, topic, partial(self.on_message, topic=topic), 10)


class CountsFromOne(Listener):
    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for number, kind in enumerate(TYPES.values(), start=1):
            topic = f"/chatter{number}"
            self.create_subscription(kind, topic, partial(self.on_message, topic=topic), 10)


class ValueWithoutTopic(Listener):
    def on_message(self, msg, topic):
        self.get_logger().info(f"{msg.data}")


class DebugLevel(Listener):
    def on_message(self, msg, topic):
        self.get_logger().debug(f"{topic}: {msg.data}")


class ForgetsBool(Listener):
    def on_message(self, msg, topic):
        if topic != "/chatter2":
            super().on_message(msg, topic)


class CallbackOfTwoArguments(Listener):
    """No one passes the second one."""

    def __init__(self):
        Node.__init__(self, "chatter_listener")
        for topic, kind in TYPES.items():
            self.create_subscription(kind, topic, self.on_message, 10)


class SaysEverything(Listener):
    """One line with all that may be right, ten times a second."""

    def __init__(self):
        super().__init__()
        words = ("dance", "jump", "sing", "swim", "sleep", "climb", "hide")
        said = [f"chatter0: {word}" for word in words]
        said += [f"chatter1: {number}.5" for number in range(10, 100)]
        self.line = " ".join([*said, "chatter2: True", "chatter2: False"])
        self.create_timer(0.1, self.say)

    def say(self):
        self.get_logger().info(self.line)

    def on_message(self, msg, topic):
        pass


class GuessesBesides(Listener):
    """One of its guesses is right now and then, and has come before the message."""

    def __init__(self):
        super().__init__()
        self.create_timer(0.1, self.guess)

    def guess(self):
        self.get_logger().info("chatter0: jump")
