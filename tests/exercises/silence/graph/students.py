"""Nodes that say who publishes on a topic: right ones, and wrong ones named by their defect."""

from rclpy.node import Node
from std_msgs.msg import String

PARTS = ("full",)


def full(end):
    return f"{end.node_namespace.rstrip('/')}/{end.node_name}"


class Reader(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("reader")
        self.publisher = self.create_publisher(String, "/answer", 10)
        self.create_subscription(String, "/question", self.answer, 10)

    def answer(self, msg):
        names = self.names(msg.data)
        self.publisher.publish(String(data=", ".join(names) or "none"))

    def names(self, topic):
        return sorted({full(end) for end in self.get_publishers_info_by_topic(topic)})


class NodeByNode(Reader):
    """A design of its own: asks each node what it publishes."""

    def names(self, topic):
        return sorted(
            f"{space.rstrip('/')}/{name}"
            for name, space in self.get_node_names_and_namespaces()
            if topic in dict(self.get_publisher_names_and_types_by_node(name, space))
        )


class Waits(Reader):
    """Answers a little later, from a timer."""

    topic = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.1, self.look)

    def answer(self, msg):
        self.topic = msg

    def look(self):
        if self.topic is not None:
            super().answer(self.topic)
        self.topic = None


class Listeners(Reader):
    def names(self, topic):
        return sorted({full(end) for end in self.get_subscriptions_info_by_topic(topic)})


class BareNames(Reader):
    def names(self, topic):
        return sorted({end.node_name for end in self.get_publishers_info_by_topic(topic)})


class NamesTwice(Reader):
    def names(self, topic):
        return sorted(full(end) for end in self.get_publishers_info_by_topic(topic))


class TurnedRound(Reader):
    def names(self, topic):
        return super().names(topic)[::-1]


class OnlyTheFirst(Reader):
    def names(self, topic):
        return super().names(topic)[:1]


class RemembersTheFirstLook(Reader):
    def __init__(self):
        super().__init__()
        self.known = {}

    def names(self, topic):
        return self.known.setdefault(topic, super().names(topic))


class EmptyForNone(Reader):
    def answer(self, msg):
        self.publisher.publish(String(data=", ".join(self.names(msg.data))))


class OneMessageForEach(Reader):
    def answer(self, msg):
        for name in self.names(msg.data):
            self.publisher.publish(String(data=name))


class OneTopicOnly(Reader):
    def names(self, topic):
        return super().names("/question")


class ReceivesNothing(Reader):
    def __init__(self):
        Node.__init__(self, "reader")
        self.publisher = self.create_publisher(String, "/answer", 10)
        self.create_subscription(String, "/questions", self.answer, 10)
