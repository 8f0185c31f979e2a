"""Publishers of seven positions: right ones, and wrong ones named by their defect."""

import math
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, Float64

SEVEN = [0.0, 0.5, -0.5, 0.0, 1.0, -1.0, 0.0]


class JointPublisher(Node):
    """As one would write it; the wrong ones change one thing each."""

    positions, period, kind, topic = tuple(SEVEN), 2.0, Float64, "/joint_commands"

    def __init__(self):
        super().__init__("joint_publisher")
        self.publisher = self.create_publisher(self.kind, self.topic, 10)
        self.index = 0
        self.create_timer(self.period, self.send)

    def send(self):
        if self.index < len(self.positions):
            self.publisher.publish(self.kind(data=self.positions[self.index]))
            self.index += 1
        else:
            self.finish()

    def finish(self):
        self.get_logger().info("All positions are sent")
        self.destroy_node()
        rclpy.shutdown()


class EndsWithTheLast(JointPublisher):
    """Doesn't wait for another tick."""

    def send(self):
        super().send()
        if self.index == len(self.positions):
            self.finish()


class ByAGenerator(JointPublisher):
    """A design of its own: the positions are a generator, and its end ends the program."""

    def __init__(self):
        super().__init__()
        self.rest = iter(self.positions)

    def send(self):
        try:
            self.publisher.publish(self.kind(data=next(self.rest)))
        except StopIteration:
            self.finish()


class SleepsInTheCallback(JointPublisher):
    """One call of the timer sends them all."""

    def send(self):
        for position in self.positions:
            self.publisher.publish(self.kind(data=position))
            time.sleep(2.0)
        self.finish()


class _Plain(Node):
    def __init__(self):
        super().__init__("joint_publisher")
        self.publisher = self.create_publisher(Float64, "joint_commands", 10)
        self.left = list(SEVEN)
        self.create_timer(2.0, self.send)

    def send(self):
        if self.left:
            self.publisher.publish(Float64(data=self.left.pop(0)))


def main_that_asks():
    """main() looks whether there is something left."""
    rclpy.init()
    node = _Plain()
    while rclpy.ok() and node.left:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()


PARTS = ("_Plain",)


class Degrees(JointPublisher):
    positions = tuple(math.degrees(position) for position in SEVEN)


class WithoutTheFirst(JointPublisher):
    def __init__(self):
        super().__init__()
        self.index = 1


class OnlySix(JointPublisher):
    positions = SEVEN[:-1]


class BeginsAnew(JointPublisher):
    def send(self):
        self.publisher.publish(Float64(data=SEVEN[self.index % 7]))
        self.index += 1


class AlwaysTheSame(JointPublisher):
    def send(self):
        self.publisher.publish(Float64(data=SEVEN[1]))


class Sorted(JointPublisher):
    positions = sorted(SEVEN)


class RunsOffTheList(JointPublisher):
    """It does end: with an IndexError."""

    def send(self):
        self.publisher.publish(Float64(data=SEVEN[self.index]))
        self.index += 1


class OnceASecond(JointPublisher):
    period = 1.0


class NeverEnds(JointPublisher):
    def finish(self):
        self.get_logger().info("All positions are sent", once=True)


class DestroysOnly(JointPublisher):
    """The node is gone, and the program waits forever."""

    def finish(self):
        self.destroy_node()


class Float32Instead(JointPublisher):
    kind = Float32


class Float32AndMisspelt(Float32Instead):
    """The misspelt name hides that the type is another one."""

    topic = "/joint_comands"


class NeverStarts(JointPublisher):
    """Without a timer no one calls send()."""

    def __init__(self):
        Node.__init__(self, "joint_publisher")
        self.publisher = self.create_publisher(Float64, "/joint_commands", 10)
