"""Listeners to commands: right ones, and wrong ones named by their defect."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, String


class Listener(Node):
    """As one would write it."""

    type, topic = String, "/robot/command"

    def __init__(self):
        super().__init__("command_listener")
        self.create_subscription(self.type, self.topic, self.obey, 10)

    def obey(self, msg):
        log = self.get_logger()
        if msg.data == "stand":
            log.info("standing")
        elif msg.data == "walk":
            log.info("walking")
        elif msg.data == "stop":
            log.info("stopping")
        else:
            log.warning(f"unknown: {msg.data}")


class ListenerWithMatch(Listener):
    def obey(self, msg):
        match msg.data:
            case "stand" | "walk":
                self.get_logger().info(f"Robot: {msg.data.upper()}ING")
            case "stop":
                self.get_logger().info("Robot: STOPPING")
            case other:
                self.get_logger().warn(f"I know stand, walk and stop, but not {other}")


def main_with_function_callback():
    answers = {"stand": "I am standing.", "walk": "I am walking.", "stop": "I am stopping."}
    rclpy.init()
    node = Node("robot")

    def obey(msg):
        if msg.data in answers:
            node.get_logger().info(answers[msg.data])
        else:
            node.get_logger().warning(f"What is {msg.data}?")

    node.create_subscription(String, "robot/command", obey, 1)
    rclpy.spin(node)


class ListenerThatAnswersFromATimer(Listener):
    """Keeps the word, and looks at it 20 times a second."""

    def __init__(self):
        super().__init__()
        self.waiting = []
        self.create_timer(0.05, self.work)

    def obey(self, msg):
        self.waiting.append(msg)

    def work(self):
        while self.waiting:
            super().obey(self.waiting.pop(0))


class AsyncListener(Listener):
    async def obey(self, msg):
        super().obey(msg)


class MisspeltTopic(Listener):
    topic = "/robot/commands"


class AnotherType(Listener):
    type = Float32


class Prints(Listener):
    def obey(self, msg):
        print({"stand": "standing", "walk": "walking", "stop": "stopping"}.get(msg.data, msg.data))


class IfInPlaceOfElif(Listener):
    """The else belongs to the last if only, so stand and walk are warned about, too."""

    def obey(self, msg):
        if msg.data == "stand":
            self.get_logger().info("standing")
        if msg.data == "walk":
            self.get_logger().info("walking")
        if msg.data == "stop":
            self.get_logger().info("stopping")
        else:
            self.get_logger().warning(f"unknown: {msg.data}")


class LooksForLetters(Listener):
    def obey(self, msg):
        for word, doing in {"stand": "standing", "walk": "walking", "stop": "stopping"}.items():
            if word in msg.data:
                self.get_logger().info(doing)
                return
        self.get_logger().warning(f"unknown: {msg.data}")


class ForgetsStop(Listener):
    def obey(self, msg):
        if msg.data in ("stand", "walk"):
            self.get_logger().info(f"{msg.data}ing")
        elif msg.data != "stop":
            self.get_logger().warning(f"unknown: {msg.data}")


class IgnoresOtherWords(Listener):
    def obey(self, msg):
        if msg.data in ("stand", "walk", "stop"):
            super().obey(msg)


class WarnsWithoutTheWord(Listener):
    def obey(self, msg):
        if msg.data in ("stand", "walk", "stop"):
            super().obey(msg)
        else:
            self.get_logger().warning("unknown command")


class SaysEverythingAtOnce(Listener):
    """Hopes that one of the words will be right."""

    def obey(self, msg):
        self.get_logger().info("standing walking stopping")
        self.get_logger().warning(msg.data)


class ComparesTheMessage(Listener):
    """msg in place of msg.data: the message is never equal to a word."""

    def obey(self, msg):
        if msg == "stand":
            self.get_logger().info("standing")
        else:
            self.get_logger().warning(f"unknown: {msg.data}")


class CallbackWithoutMessage(Listener):
    def obey(self):
        pass


class CallsAMethodThatIsNotThere(Listener):
    def obey(self, msg):
        self.get_logger().inform(msg.data)


class CommandSender(Listener):
    """Called like the node that sends the words, and fails."""

    def obey(self, msg):
        raise ZeroDivisionError("by a student")


class LogsAllAnswers(Listener):
    """Whatever the word is, one long line has every answer."""

    def obey(self, msg):
        answers = "standing walking stopping " * 20
        self.get_logger().info(answers)
        self.get_logger().warning(f"{answers} unknown: {msg.data}")
