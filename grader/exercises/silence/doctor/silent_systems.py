"""Six systems of a sensor and a display, each with a fault of its own, and a node that complains."""

import functools
import random
from collections.abc import Callable
from typing import Any, NamedTuple

from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.validate_full_topic_name import validate_full_topic_name
from std_msgs.msg import String

FAULTS = "name", "missing", "reliability", "durability", "deadline", "mute"
SPACES = "kitchen", "garage", "garden", "attic", "cellar", "office", "porch", "hall", "studio", "library"
TOPICS = "temperature", "pressure", "brightness", "humidity", "loudness", "speech", "picture", "position"
FIRST, PAUSE = 1.0, 1.0  # s: the first complaint, and the time between two
OFFERED, WANTED = (0.3, 0.4, 0.5), 0.2  # s, deadlines
PERIOD = 0.1  # s between two messages
LONGEST = 1e6  # s, a deadline
STRING = "std_msgs/msg/String"
BEST_EFFORT = {True: ReliabilityPolicy.BEST_EFFORT, False: ReliabilityPolicy.RELIABLE}
TRANSIENT = {True: DurabilityPolicy.TRANSIENT_LOCAL, False: DurabilityPolicy.VOLATILE}
POLICIES = {"reliability": ("best_effort", "reliable"), "durability": ("volatile", "transient_local")}


class SilentSystem(NamedTuple):
    """A system: a sensor, a display that should receive its messages, and the fault between them."""

    fault: str
    space: str
    topic: str  # that the display waits for, with its namespace
    spoken: str  # that the sensor publishes on
    deadline: float  # s, that the sensor offers; 0 without
    durable: bool  # a decoy: it is compatible, and looks as if it weren't
    weak: bool  # another one


def cases(seed: int) -> list[SilentSystem]:
    """Return the six systems of a seed, one with each fault, in the order of the complaints."""
    draw = random.Random(f"ward {seed}")
    spaces, topics = draw.sample(SPACES, 6), draw.sample(TOPICS, 6)
    found = []
    for fault, space, word in zip(draw.sample(FAULTS, 6), spaces, topics, strict=True):
        topic = spoken = f"/{space}/{word}"
        if fault == "name":
            spoken = f"/{space}/{_misspelt(word, draw)}"
        offered = draw.choice(OFFERED) if fault == "deadline" else draw.choice((0.0, 0.15, 0.2))
        row = fault, space, topic, spoken, offered, draw.random() < 0.5, draw.random() < 0.5
        found.append(SilentSystem(*row))
    return found


def _misspelt(word: str, draw: random.Random) -> str:
    """Return the word with two letters swapped, or without one."""
    place = draw.choice([at for at in range(1, len(word) - 1) if word[at] != word[at + 1]])
    if draw.random() < 0.5:
        return word[:place] + word[place + 1] + word[place] + word[place + 2 :]
    return word[:place] + word[place + 1 :]


class FaultySensor(Node):
    """Publishes String messages, ten a second, while its parameter `running` is true."""

    def __init__(self, case: SilentSystem) -> None:
        super().__init__("sensor", namespace=case.space)
        profile = QoSProfile(depth=5)
        profile.reliability = BEST_EFFORT[case.fault == "reliability" or case.weak]
        profile.durability = TRANSIENT[case.fault != "durability" and case.durable]
        profile.deadline = Duration(seconds=case.deadline)
        self.count = random.randrange(10**9)  # so that no other node can know its messages
        self.declare_parameter("running", case.fault != "mute")
        self.publisher = self.create_publisher(String, case.spoken, profile)
        self.create_timer(PERIOD, self.speak)

    def speak(self) -> None:
        """Publish the next number."""
        if self.get_parameter("running").value:
            self.count += 1
            self.publisher.publish(String(data=str(self.count)))


class ConfigurableDisplay(Node):
    """Subscribes to a sensor. Its parameters set the topic and the QoS.

    Each time one of them is set, it subscribes again. It publishes what it receives on /received, and what is
    set on /changes, both after the name of the topic that it has at the beginning.
    """

    def __init__(self, case: SilentSystem) -> None:
        super().__init__("display", namespace=case.space)
        self.case = case
        weak = case.fault != "reliability" and case.weak
        settings = {
            "topic": case.topic,
            "reliability": BEST_EFFORT[weak].name.lower(),
            "durability": TRANSIENT[case.fault == "durability"].name.lower(),
            "deadline": WANTED if case.fault == "deadline" else 0.0,
        }
        self.received = self.create_publisher(String, "/received", 10)
        self.changes = self.create_publisher(String, "/changes", 10)
        for name, value in settings.items():
            self.declare_parameter(name, value)
        self.subscription: Any = None
        self.listen()
        self.add_on_set_parameters_callback(self.check)
        self.add_post_set_parameters_callback(self.change)

    def listen(self) -> None:
        """Subscribe, as the parameters say."""
        given = {name: self.get_parameter(name).value for name in ("topic", "reliability", "durability")}
        profile = QoSProfile(depth=5)
        profile.reliability = ReliabilityPolicy[given["reliability"].upper()]
        profile.durability = DurabilityPolicy[given["durability"].upper()]
        profile.deadline = Duration(seconds=self.get_parameter("deadline").value)
        if self.subscription is not None:
            self.destroy_subscription(self.subscription)
        self.subscription = self.create_subscription(String, given["topic"], self.on_message, profile)

    def on_message(self, msg: String) -> None:
        """Publish what was received."""
        self.received.publish(String(data=f"{self.case.topic} {msg.data}"))

    def check(self, parameters: list[Parameter]) -> SetParametersResult:
        """Reject what a subscription cannot have."""
        wrong = [parameter.name for parameter in parameters if not self.can_be(parameter)]
        reason = f"impossible: {', '.join(wrong)}" if wrong else ""
        return SetParametersResult(successful=not wrong, reason=reason)

    def can_be(self, parameter: Parameter) -> bool:
        """Return whether a subscription can have this setting."""
        name, value = parameter.name, parameter.value
        if name in POLICIES:
            return value in POLICIES[name]
        if name == "deadline":
            return bool(0.0 <= value < LONGEST)
        if name != "topic":
            return True
        try:
            validate_full_topic_name(value)
        except InvalidTopicNameException:
            return False
        return dict(self.get_topic_names_and_types()).get(value, [STRING]) == [STRING]

    def change(self, parameters: list[Parameter]) -> None:
        """Subscribe again, and publish what was set."""
        for parameter in parameters:
            self.changes.publish(String(data=f"{self.case.topic} {parameter.name}"))
        self.listen()


class ComplaintPublisher(Node):
    """Publishes on /complaint (String) the topic of one display after another that receives nothing."""

    def __init__(self, topics: list[str]) -> None:
        super().__init__("caller")
        self.publisher = self.create_publisher(String, "/complaint", 10)
        self.topics = topics[::-1]
        self.create_timer(PAUSE, self.complain)

    def complain(self) -> None:
        """Publish the next complaint, as long as there is one."""
        if self.topics:
            self.publisher.publish(String(data=self.topics.pop()))


def silent_systems(seed: int) -> list[Callable[[], Node]]:
    """Return the six systems of a seed and the complaints, as companions of a run."""
    made: list[Callable[[], Node]] = []
    for case in cases(seed):
        made.append(functools.partial(ConfigurableDisplay, case))
        if case.fault != "missing":
            made.append(functools.partial(FaultySensor, case))
    return [*made, functools.partial(ComplaintPublisher, [case.topic for case in cases(seed)])]
