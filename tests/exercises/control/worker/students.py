"""Programs that look at pictures while a pole must stand: right, and wrong ones named by their defect."""

import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Int32, UInt8MultiArray


def look(picture):
    """Hard work."""
    time.sleep(0.3)
    pixels = list(picture.data)
    return pixels.index(max(pixels))


class Robot(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("robot")
        self.efforts = self.create_publisher(Float64, "/cart_effort", 10)
        self.places = self.create_publisher(Int32, "/brightest", 10)
        joints, pictures = self.groups()
        self.create_subscription(JointState, "/joint_states", self.balance, 10, callback_group=joints)
        self.create_subscription(UInt8MultiArray, "/picture", self.on_picture, 10, callback_group=pictures)

    def groups(self):
        return None, MutuallyExclusiveCallbackGroup()

    def balance(self, msg):
        (x, angle), (speed, rate) = msg.position, msg.velocity
        self.efforts.publish(Float64(data=-60.0 * angle - 8.0 * rate + 10.0 * x + 11.0 * speed))

    def on_picture(self, msg):
        self.answer(look(msg))

    def answer(self, place):
        self.places.publish(Int32(data=place))


class OneForAll(Robot):
    def groups(self):
        return 2 * (ReentrantCallbackGroup(),)


class OwnThread(Robot):
    """A thread does the work."""

    def groups(self):
        return None, None

    def on_picture(self, msg):
        threading.Thread(target=lambda: Robot.on_picture(self, msg)).start()


class Default(Robot):
    def groups(self):
        return None, None


class SameGroup(Robot):
    """A group of its own, but one for both."""

    def groups(self):
        return 2 * (MutuallyExclusiveCallbackGroup(),)


class Hurries(Robot):
    """Guesses before it has looked."""

    def on_picture(self, msg):
        self.answer(list(msg.data).index(max(msg.data)))


class Darkest(Robot):
    def on_picture(self, msg):
        look(msg)
        self.answer(list(msg.data).index(min(msg.data)))


class EverySecond(Robot):
    """Leaves every second picture out, to have more time."""

    count = 0

    def on_picture(self, msg):
        self.count += 1
        if self.count % 2:
            super().on_picture(msg)


class SaysItTwice(Robot):
    def answer(self, place):
        super().answer(place)
        super().answer(place)


class SlowLoop(Robot):
    """Pushes with every fifth joint state only."""

    count = 0

    def balance(self, msg):
        self.count += 1
        if self.count % 5 == 0:
            super().balance(msg)


class Rests(Robot):
    """While it looks for a picture's place, the pole has to see how it gets on for a fifth of a second."""

    until = 0.0

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_picture(self, msg):
        self.until = self.now() + 0.21
        super().on_picture(msg)

    def balance(self, msg):
        if self.now() >= self.until:
            super().balance(msg)


class SaysAnything(Default):
    """Doesn't look, and so nothing holds the loop up."""

    def on_picture(self, msg):
        self.answer(0)


class NeverLooks(Robot):
    def on_picture(self, msg):
        pass


def spun(make, executor):
    """A main() that has this executor spin the node."""

    def main():
        rclpy.init()
        spinner = executor()
        spinner.add_node(make())
        spinner.spin()

    return main


def threads():
    return MultiThreadedExecutor(num_threads=2)


own_group = spun(Robot, threads)
reentrant = spun(OneForAll, lambda: MultiThreadedExecutor(num_threads=4))
own_thread = spun(OwnThread, SingleThreadedExecutor)  # a design of its own
default_group = spun(Default, threads)
same_group = spun(SameGroup, threads)
one_thread = spun(Robot, SingleThreadedExecutor)
num_threads_1 = spun(Robot, lambda: MultiThreadedExecutor(num_threads=1))
hurries = spun(Hurries, threads)
darkest = spun(Darkest, threads)
every_second = spun(EverySecond, threads)
says_it_twice = spun(SaysItTwice, threads)
slow_loop = spun(SlowLoop, threads)
rests = spun(Rests, threads)
never_looks = spun(NeverLooks, threads)

PARTS = (
    "Robot",
    "OneForAll",
    "OwnThread",
    "Default",
    "SameGroup",
    "Hurries",
    "Darkest",
    "EverySecond",
    "SaysItTwice",
    "SlowLoop",
    "Rests",
    "SaysAnything",
    "NeverLooks",
    "look",
    "spun",
    "threads",
)
