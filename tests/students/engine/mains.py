"""Every shape of a whole program that a tutorial shows: main() functions as they would run on a robot."""

import rclpy
from rclpy import init, shutdown, spin
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class Counter(Node):
    """Publishes 1, 2, 3, ... on /count, twice a second."""

    def __init__(self, name="counter"):
        super().__init__(name)
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.count = 0
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.count += 1
        self.publisher.publish(Int32(data=self.count))


def classic(args=None):
    rclpy.init(args=args)
    node = Counter()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


def with_finally(args=None):
    rclpy.init(args=args)
    node = Counter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def bound_early():
    init()
    spin(Counter())
    shutdown()


def with_arguments_of_its_own(name="renamed"):
    rclpy.init()
    rclpy.spin(Counter(name))


def own_executor():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Counter())
    executor.spin()


def two_nodes_one_executor():
    rclpy.init()
    executor = SingleThreadedExecutor()
    first, second = Counter("first"), Counter("second")
    executor.add_node(first)
    executor.add_node(second)
    try:
        executor.spin()
    finally:
        executor.shutdown()
        first.destroy_node()
        second.destroy_node()


def spin_once_loop():
    rclpy.init()
    node = Counter()
    while rclpy.ok():
        rclpy.spin_once(node)


def spin_once_with_timeout():
    """Its own count goes out whether or not the timer did: twelve loops in three seconds."""
    rclpy.init()
    node = Node("loop")
    publisher = node.create_publisher(Int32, "count", 10)
    for count in range(12):
        publisher.publish(Int32(data=count))
        rclpy.spin_once(node, timeout_sec=0.25)


def spin_once_polling():
    """timeout_sec=0 never waits; reading the clock is what lets time go on."""
    rclpy.init()
    node = Counter()
    while node.count < 3:
        rclpy.spin_once(node, timeout_sec=0)
        node.get_clock().now()


def busy_ok_loop():
    rclpy.init()
    node = Counter()
    end = node.get_clock().now() + Duration(seconds=2.0)
    while rclpy.ok() and node.get_clock().now() < end:
        pass
    node.get_logger().info("two seconds are over")


def shuts_itself_down():
    rclpy.init()
    node = Counter()

    def stop():
        node.get_logger().info("enough")
        rclpy.shutdown()

    node.create_timer(1.75, stop)
    rclpy.spin(node)
    node.destroy_node()


def raises_to_leave_spin():
    rclpy.init()
    node = Counter()

    def stop():
        raise SystemExit

    node.create_timer(1.25, stop)
    try:
        rclpy.spin(node)
    except SystemExit:
        node.get_logger().info("done")
    rclpy.shutdown()


def init_again():
    """Start, stop, and start again: each time a fresh node on a fresh context."""
    for name in ("one", "two"):
        rclpy.init()
        node = Counter(name)
        while node.count < 2:
            rclpy.spin_once(node)
        node.destroy_node()
        rclpy.shutdown()


def own_context():
    context = rclpy.Context()
    rclpy.init(context=context)
    node = Node("own", context=context)
    publisher = node.create_publisher(Int32, "count", 10)
    node.create_timer(1.0, lambda: publisher.publish(Int32(data=7)))
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.spin()


def only_a_node():
    """Not a main(): it makes the node and leaves the rest to its caller."""
    return Counter("made")


def makes_one_with_init():
    rclpy.init()
    return Counter("made")
