"""Nodes with one mistake each, named by it: every exception that the diagnosis puts into words."""

import math
import threading
import time

import rclpy
from geometry_msgs.msg import PoseWithCovariance, Twist
from nav_msgs.msg import OccupancyGrid
from rcl_interfaces.msg import ParameterValue
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Byte, Float64, Int32, String
from trajectory_msgs.msg import JointTrajectory


class Talker(Node):
    """What the others are built on: a publisher, and a timer that calls `tick` after 1 s."""

    message_type = String

    def __init__(self):
        super().__init__("talker")
        self.publisher = self.create_publisher(self.message_type, "chatter", 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.publisher.publish(self.message_type())


class WholeNumberForFloat(Talker):
    def tick(self):
        msg = Float64()
        msg.data = 1


class DecimalsForWholeNumber(Talker):
    def tick(self):
        msg = Int32()
        msg.data = 1.5


class NumberForText(Talker):
    def tick(self):
        msg = String()
        msg.data = 5


class NumberForBool(Talker):
    def tick(self):
        msg = Bool()
        msg.data = 1


class NumberForByte(Talker):
    def tick(self):
        msg = Byte()
        msg.data = 1


class WordsForNumbers(Talker):
    def tick(self):
        msg = JointState()
        msg.velocity = ["fast"]


class FractionsForWholeNumbers(Talker):
    def tick(self):
        msg = OccupancyGrid()
        msg.data = [0.5]


class NumbersForNames(Talker):
    def tick(self):
        msg = JointState()
        msg.name = [1, 2]


class NumbersForFlags(Talker):
    def tick(self):
        msg = ParameterValue()
        msg.bool_array_value = [1, 2, 3]


class NumbersForPoints(Talker):
    def tick(self):
        msg = JointTrajectory()
        msg.points = [1.0]


class TooFewValues(Talker):
    def tick(self):
        msg = PoseWithCovariance()
        msg.covariance = [0.0] * 35


class SuperWithoutParentheses(Node):
    def __init__(self):
        super.__init__("talker")


class TimerOfSuperWithoutParentheses(Talker):
    def tick(self):
        super.create_timer(1.0, self.tick)


class PassesSelfToSuper(Node):
    def __init__(self):
        super().__init__(self, "talker")


class NumberForSubMessage(Talker):
    def tick(self):
        msg = Twist()
        msg.linear = 0.5


class NumberTooLarge(Talker):
    def tick(self):
        msg = Int32()
        msg.data = 2**40


class UnknownFieldInConstructor(Talker):
    def tick(self):
        String(text="hello")


class FieldByPosition(Talker):
    def tick(self):
        String("hello")


class UnknownField(Talker):
    def tick(self):
        msg = Twist()
        msg.speed = 1.0


class PublishesTheClass(Talker):
    def tick(self):
        self.publisher.publish(String)


class PublishesPlainText(Talker):
    def tick(self):
        self.publisher.publish("hello")


class PublishesAnotherType(Talker):
    def tick(self):
        self.publisher.publish(Float64(data=1.0))


class NodeWithoutName(Node):
    def __init__(self):
        super().__init__()


class NodeNameWithSpace(Node):
    def __init__(self):
        super().__init__("my node")


class TopicNameWithSpace(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_publisher(String, "my topic", 10)


class NoSuperInit(Node):
    def __init__(self):
        self.publisher = self.create_publisher(String, "chatter", 10)


class NoQueueLength(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_publisher(String, "chatter")


class SubscriptionWithoutCallback(Node):
    def __init__(self):
        super().__init__("listener")
        self.create_subscription(String, "chatter", 10)


class NameBeforeType(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_publisher("chatter", String, 10)


class PublishesPythonsText(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_publisher(str, "chatter", 10)


class QueueLengthAsText(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_publisher(String, "chatter", "10")


class CallbackBeforePeriod(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_timer(self.tick, 1.0)

    def tick(self):
        pass


class CallbackCalled(Talker):
    def __init__(self):
        Node.__init__(self, "talker")
        self.create_timer(1.0, self.tick())

    def tick(self):
        pass


class NegativePeriod(Talker):
    def __init__(self):
        Node.__init__(self, "talker")
        self.create_timer(-1.0, self.tick)


class LogsTwoThings(Talker):
    def tick(self):
        self.get_logger().info("count", 3)


class LogsANumber(Talker):
    def tick(self):
        self.get_logger().info(5)


class TimerCallbackWithoutSelf(Talker):
    def tick():
        pass


class TimerCallbackWantsMessage(Talker):
    def tick(self, msg):
        pass


class Listener(Talker):
    """Receives itself."""

    def __init__(self):
        super().__init__()
        self.create_subscription(String, "chatter", self.on_message, 10)

    def on_message(self, msg):
        pass


class SubscriptionCallbackWithoutMessage(Listener):
    def on_message(self):
        pass


class ForwardsToMethodWithoutMessage(Listener):
    def on_message(self, msg):
        self.obey(msg)

    def obey(self):
        pass


class UndeclaredParameter(Talker):
    def tick(self):
        self.get_parameter("speed")


class MisspeltMethod(Node):
    def __init__(self):
        super().__init__("talker")
        self.create_timer(1.0, self.tik)

    def tick(self):
        pass


class ValueBeforeItIsSet(Talker):
    def tick(self):
        self.count += 1


class NothingThere(Talker):
    def tick(self):
        self.other = None
        self.other.publish(String())


class ForgottenImport(Talker):
    def tick(self):
        self.publisher.publish(Imu())  # noqa: F821


class MisspeltType(Talker):
    def tick(self):
        self.publisher.publish(Strng())  # noqa: F821


class ForgottenSelf(Talker):
    def __init__(self):
        super().__init__()
        self.count = 0

    def tick(self):
        print(count)  # noqa: F821


class ForgottenModule(Talker):
    def tick(self):
        import std_msg.msg  # noqa: F401


class WrongNameFromModule(Talker):
    def tick(self):
        from std_msgs.msg import Sting  # noqa: F401


class DividesByZero(Talker):
    def tick(self):
        return 1 / 0


class NotStarted(Node):
    def __init__(self):
        raise NotImplementedError("publish a count once a second")


class FormatsNothing(Talker):
    def tick(self):
        self.get_logger().info(f"{self.publisher.publish(String()):.1f}")


class OneLineForTwoLevels(Talker):
    def tick(self):
        for log in (self.get_logger().info, self.get_logger().warning):
            log("Is this bad?")


class LevelAsText(Talker):
    def tick(self):
        self.get_logger().set_level("debug")


class BeyondTheLast(Talker):
    def tick(self):
        print((1, 2)[2])


class LoggerWithoutBrackets(Talker):
    def tick(self):
        self.get_logger.info("tick")


class LeavesTheRaiseBelowItsCode(Talker):
    def tick(self):
        super().tick()
        raise NotImplementedError()


class NotStartedWithoutWords(Talker):
    def tick(self):
        raise NotImplementedError


def main_with_namespace_without_slash():
    rclpy.init(args=["--ros-args", "-r", "__ns:=robot1"])
    Node("talker")


def main_with_space_in_a_remapping():
    rclpy.init(args=["--ros-args", "-r", "chatter:=my chatter"])
    Node("talker")


def main_without_init():
    rclpy.spin(Talker())


def main_with_two_inits():
    rclpy.init()
    rclpy.init()


def main_with_two_shutdowns():
    rclpy.init()
    rclpy.shutdown()
    rclpy.shutdown()


def main_that_publishes_after_shutdown():
    rclpy.init()
    node = Talker()
    rclpy.shutdown()
    node.tick()


def main_that_misuses_a_list():
    rclpy.init()
    print([1, 2].size)


def main_that_logs_at_no_level():
    rclpy.init()
    Node("logger").get_logger().warn_once("only once")


class StartsThreadsWithoutEnd(Node):
    """A leak: each thread sleeps, and the loop goes on."""

    def __init__(self):
        super().__init__("leak")
        self.create_timer(0.5, self.work)

    def work(self):
        while True:
            threading.Thread(target=time.sleep, args=(1000,)).start()


class NamesAProperty(Talker):
    def __init__(self):
        super().__init__()
        self.publishers = []


class SetsBeyondTheLast(Talker):
    def tick(self):
        numbers = [1, 2]
        numbers[2] = 3


class RaisesInItsOwnWords(Talker):
    def tick(self):
        raise ValueError("the arm is too far to the left")


class MisspellsAFunction(Talker):
    def tick(self):
        return math.sine(1.0)


class ForgetsTheState(LifecycleNode):
    def __init__(self):
        super().__init__("motor")
        self.create_timer(0.5, self.trigger_configure)

    def on_configure(self):
        return TransitionCallbackReturn.SUCCESS


class ReturnsNothing(ForgetsTheState):
    def on_configure(self, state):
        self.ready = True
