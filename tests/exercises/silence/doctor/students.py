"""Doctors for silent systems: right ones, and wrong ones named by their defect."""

import difflib

import rclpy
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy, qos_check_compatible
from std_msgs.msg import String

PARTS = ("full",)


def full(end):
    return f"{end.node_namespace}/{end.node_name}"


class Doctor(Node):
    """As one would write it; the wrong ones change one thing each."""

    fixes = True

    def __init__(self):
        super().__init__("doctor")
        self.publisher = self.create_publisher(String, "/diagnosis", 10)
        self.create_subscription(String, "/complaint", self.on_message, 10)

    def on_message(self, msg):
        self.publisher.publish(String(data=f"{msg.data}: {self.examine(msg.data)}"))

    def set(self, end, name, value):
        if self.fixes:
            client = AsyncParameterClient(self, full(end))
            if client.wait_for_services(1.0):
                client.set_parameters([Parameter(name, value=value)])

    def examine(self, topic):
        display = self.get_subscriptions_info_by_topic(topic)[0]
        sensors = self.get_publishers_info_by_topic(topic)
        if not sensors:
            return self.find(topic, display)
        return self.compare(display, sensors[0])

    def find(self, topic, display):
        others = [name for name, _ in self.get_topic_names_and_types() if name != topic]
        near = difflib.get_close_matches(topic, others, n=1, cutoff=0.8)
        if not near:
            return "missing"
        self.set(display, "topic", near[0])
        return "name"

    def compare(self, display, sensor):
        asked, offered = display.qos_profile, sensor.qos_profile
        if asked.reliability == ReliabilityPolicy.RELIABLE != offered.reliability:
            self.set(display, "reliability", "best_effort")
            return "reliability"
        if asked.durability == DurabilityPolicy.TRANSIENT_LOCAL != offered.durability:
            self.set(display, "durability", "volatile")
            return "durability"
        if asked.deadline < offered.deadline:
            self.set(display, "deadline", offered.deadline.nanoseconds / 1e9)
            return "deadline"
        self.set(sensor, "running", True)
        return "mute"


class AsksRclpy(Doctor):
    """A design of its own: has rclpy compare the settings, and reads its reason."""

    CURES = (
        ("best effort publisher", "reliability", "best_effort"),
        ("volatile publisher", "durability", "volatile"),
        ("deadline", "deadline", 0.0),
    )

    def compare(self, display, sensor):
        _, reason = qos_check_compatible(sensor.qos_profile, display.qos_profile)
        for sign, name, value in self.CURES:
            if sign in reason.lower():
                self.set(display, name, value)
                return name
        self.set(sensor, "running", True)
        return "mute"


class ByHand(Doctor):
    """Calls the service itself, and finds names by their first letters."""

    def set(self, end, name, value):
        kinds = {
            bool: (ParameterType.PARAMETER_BOOL, "bool_value"),
            float: (ParameterType.PARAMETER_DOUBLE, "double_value"),
            str: (ParameterType.PARAMETER_STRING, "string_value"),
        }
        kind, field = kinds[type(value)]
        setting = ParameterMsg(name=name, value=ParameterValue(type=kind, **{field: value}))
        client = self.create_client(SetParameters, f"{full(end)}/set_parameters")
        client.wait_for_service(1.0)
        client.call_async(SetParameters.Request(parameters=[setting]))

    def find(self, topic, display):
        space = topic.rpartition("/")[0]
        for name, types in self.get_topic_names_and_types():
            lonely = self.count_publishers(name) and not self.count_subscribers(name)
            if name.startswith(space) and types == ["std_msgs/msg/String"] and lonely:
                self.set(display, "topic", name)
                return "name"
        return "missing"


def main_without_a_class():
    rclpy.init()
    node = Doctor()
    rclpy.spin(node)


class TakesAnyDifference(Doctor):
    """Settings that differ may fit all the same."""

    def compare(self, display, sensor):
        asked, offered = display.qos_profile, sensor.qos_profile
        for name, cure in (("reliability", "best_effort"), ("durability", "volatile"), ("deadline", 0.0)):
            if getattr(asked, name) != getattr(offered, name):
                self.set(display, name, cure)
                return name
        return super().compare(display, sensor)


class TakesAnyName(Doctor):
    def find(self, topic, display):
        others = [name for name, _ in self.get_topic_names_and_types() if name != topic]
        self.set(display, "topic", difflib.get_close_matches(topic, others, n=1, cutoff=0.0)[0])
        return "name"


class MissingForEveryName(Doctor):
    def find(self, topic, display):
        return "missing"


class FixesTheWrongEnd(Doctor):
    """Sets the sensor, which has no such parameter; and tells the display to run."""

    def set(self, end, name, value):
        other = "display" if end.node_name == "sensor" else "sensor"
        end.node_name = other
        super().set(end, name, value)


class ForgetsTheNamespace(Doctor):
    def find(self, topic, display):
        others = [name for name, _ in self.get_topic_names_and_types() if name != topic]
        near = difflib.get_close_matches(topic, others, n=1, cutoff=0.8)
        if near:
            self.set(display, "topic", near[0].rpartition("/")[2][:-1])
        return "name" if near else "missing"


class SetsWhatIsSet(Doctor):
    def set(self, end, name, value):
        same = {"reliability": "reliable", "durability": "transient_local", "deadline": 0.2}
        super().set(end, name, same.get(name, value))


class SilentForMissing(Doctor):
    def on_message(self, msg):
        word = self.examine(msg.data)
        if word != "missing":
            self.publisher.publish(String(data=f"{msg.data}: {word}"))


class CapitalLetters(Doctor):
    def on_message(self, msg):
        self.publisher.publish(String(data=f"{msg.data}: {self.examine(msg.data).upper()}"))


class MuteForAll(Doctor):
    def examine(self, topic):
        return "mute"


class SaysAllWords(Doctor):
    def on_message(self, msg):
        for word in ("name", "missing", "reliability", "durability", "deadline", "mute"):
            self.publisher.publish(String(data=f"{msg.data}: {word}"))


class ChangesEverything(Doctor):
    """Fixes by chance, and breaks what was right."""

    def compare(self, display, sensor):
        self.set(display, "reliability", "best_effort")
        self.set(display, "durability", "volatile")
        self.set(display, "deadline", 0.0)
        return super().compare(display, sensor)


class PublishesInItsPlace(Doctor):
    """Says something on the topic, so that the display receives anything at all."""

    fixes = False

    def examine(self, topic):
        outlet = self.create_publisher(String, topic, 10)
        self.create_timer(0.1, lambda: outlet.publish(String(data="1")))
        return super().examine(topic)


class ReceivesNothing(Doctor):
    def __init__(self):
        Node.__init__(self, "doctor")
        self.publisher = self.create_publisher(String, "/diagnosis", 10)
        self.create_subscription(String, "/calls", self.on_message, 10)


class TriesOneAfterTheOther(Doctor):
    """Sets this and that, and asks the display whether it helped: the last one must have been it."""

    def __init__(self):
        super().__init__()
        self.receives, self.topic, self.tries, self.word = set(), "", [], ""
        self.create_subscription(String, "/received", lambda msg: self.receives.add(msg.data.split()[0]), 10)
        self.create_timer(0.15, self.attempt)

    def on_message(self, msg):
        self.topic, self.word, self.tries = msg.data, "", []
        word = self.examine(msg.data)
        if not self.tries:
            self.publisher.publish(String(data=f"{msg.data}: {word}"))

    def compare(self, display, sensor):
        self.tries = [(sensor, "running", True, "mute")]
        self.tries += [(display, "reliability", "best_effort", "reliability")]
        self.tries += [(display, "durability", "volatile", "durability")]
        self.tries += [(display, "deadline", 0.0, "deadline")]
        return "not known yet"

    def attempt(self):
        if self.word and self.topic in self.receives:
            self.publisher.publish(String(data=f"{self.topic}: {self.word}"))
            self.tries, self.word = [], ""
        elif self.tries:
            end, name, value, self.word = self.tries.pop(0)
            self.set(end, name, value)


class MuteForReliability(Doctor):
    def examine(self, topic):
        return super().examine(topic).replace("reliability", "mute")


class MuteForDurability(Doctor):
    def examine(self, topic):
        return super().examine(topic).replace("durability", "mute")


class LeavesItMute(Doctor):
    def set(self, end, name, value):
        if name != "running":
            super().set(end, name, value)


class SetsItsOwnDurability(Doctor):
    """The display has it already: it is what the sensor doesn't offer."""

    def set(self, end, name, value):
        super().set(end, name, "transient_local" if name == "durability" else value)


class NearlyTheName(Doctor):
    def set(self, end, name, value):
        super().set(end, name, f"{value}s" if name == "topic" else value)
