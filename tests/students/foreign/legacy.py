"""Programs of people who come from ROS 1 or from plain scripts: globals, loops, rates, exit codes."""

import atexit
import logging
import signal
import sys
import threading
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from std_msgs.msg import Float64, String

node = None
publisher = None
received = 0


def callback(data):
    global received
    received += 1
    node.get_logger().info("I heard %s" % data.data)  # noqa: UP031


def global_listener():
    """A node, its publisher and its state are global variables."""
    global node, publisher
    rclpy.init(args=sys.argv)
    node = rclpy.create_node("listener")
    node.create_subscription(String, "chatter", callback, 10)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def talker_with_spin_once(args=None):
    """The loop of ROS 1: publish, and give ROS some time."""
    rclpy.init(args=args)
    talker = rclpy.create_node("talker")
    pub = talker.create_publisher(String, "chatter", 10)
    count = 0
    while rclpy.ok():
        pub.publish(String(data="hello world %d" % count))  # noqa: UP031
        count += 1
        try:
            rclpy.spin_once(talker, timeout_sec=0.1)
            time.sleep(0.1)
        except (KeyboardInterrupt, ExternalShutdownException):
            break


def talker_with_rate():
    """rospy.Rate, with a thread that spins."""
    rclpy.init()
    talker = Node("talker")
    thread = threading.Thread(target=rclpy.spin, args=(talker,), daemon=True)
    thread.start()
    pub = talker.create_publisher(String, "chatter", 10)
    rate = talker.create_rate(10)
    try:
        while rclpy.ok():
            pub.publish(String(data="hello"))
            rate.sleep()
    except (KeyboardInterrupt, ExternalShutdownException, rclpy.exceptions.ROSInterruptException):
        pass


class Spinner(object):  # noqa: UP004
    """A class that is no node, as in ROS 1."""

    def __init__(self):
        self.node = rclpy.create_node("spinner")
        self.pub = self.node.create_publisher(Float64, "angle", 10)
        self.sub = self.node.create_subscription(Float64, "angle_command", self.cb, 10)
        self.angle = 0.0

    def cb(self, msg):
        # type: (Float64) -> None
        self.angle = msg.data

    def run(self):
        # type: () -> None
        while rclpy.ok():
            rclpy.spin_once(self.node, timeout_sec=0.05)
            self.angle += 0.01  # type: float
            self.pub.publish(Float64(data=self.angle))


def spinner():
    rclpy.init()
    try:
        Spinner().run()
    except (KeyboardInterrupt, ExternalShutdownException):
        return


def exits_with_a_code():
    """Returns its status, as commands do, after it has published for a while."""
    arguments = remove_ros_args(sys.argv)[1:]
    rclpy.init()
    reporter = Node("reporter")
    pub = reporter.create_publisher(String, "chatter", 10)
    for _ in range(int(arguments[0]) if arguments else 3):
        pub.publish(String(data="still here"))
        rclpy.spin_once(reporter, timeout_sec=0.1)
    reporter.destroy_node()
    rclpy.shutdown()
    sys.exit(0)


def handles_signals_itself():
    """Ends at SIGTERM by a flag, and logs with Python's own logging."""
    stop = threading.Event()
    log = logging.getLogger("plain")
    rclpy.init()
    keeper = Node("keeper")
    pub = keeper.create_publisher(String, "chatter", 10)
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    while rclpy.ok() and not stop.is_set():
        pub.publish(String(data="alive"))
        log.debug("published")
        try:
            rclpy.spin_once(keeper, timeout_sec=0.2)
        except (KeyboardInterrupt, ExternalShutdownException):
            break


def cleans_up_at_exit():
    rclpy.init()
    atexit.register(rclpy.try_shutdown)
    beacon = rclpy.create_node("beacon")
    pub = beacon.create_publisher(String, "chatter", 1)
    beacon.create_timer(0.5, lambda: pub.publish(String(data="beep")))
    try:
        rclpy.spin(beacon)
    except (KeyboardInterrupt, ExternalShutdownException):
        atexit.unregister(rclpy.try_shutdown)


def drives_in_a_loop():
    """Drives forward for a second, and then stops; a script without callbacks."""
    rclpy.init()
    driver = rclpy.create_node("driver")
    pub = driver.create_publisher(Twist, "/cmd_vel", 10)
    twist = Twist()
    begin = driver.get_clock().now()
    try:
        while (driver.get_clock().now() - begin).nanoseconds < 1e9:
            twist.linear.x = 0.2
            pub.publish(twist)
            rclpy.spin_once(driver, timeout_sec=0.1)
        pub.publish(Twist())
        rclpy.spin(driver)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


class WaitsInItsConstructor(Node):
    """Waits for the first message before it is complete, as rospy.wait_for_message did."""

    def __init__(self):
        super().__init__("waits")
        self.first = None
        subscription = self.create_subscription(String, "chatter", self.take, 10)
        while self.first is None:
            rclpy.spin_once(self, timeout_sec=0.1)
        self.destroy_subscription(subscription)
        self.publisher = self.create_publisher(String, "first", 10)
        self.create_timer(0.5, lambda: self.publisher.publish(self.first))

    def take(self, message):
        self.first = message


def waits_for_a_message():
    rclpy.init()
    try:
        rclpy.spin(WaitsInItsConstructor())
    except (KeyboardInterrupt, ExternalShutdownException):
        rclpy.try_shutdown()


CORPUS = [
    (talker_with_spin_once, global_listener),
    (talker_with_rate, global_listener),
    (spinner,),
    (exits_with_a_code,),
    (handles_signals_itself,),
    (cleans_up_at_exit, global_listener),
    (drives_in_a_loop,),
    (waits_for_a_message, talker_with_spin_once),
]
