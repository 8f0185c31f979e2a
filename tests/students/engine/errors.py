"""Nodes that raise, each in another place."""

import contextlib
import os
import sys
import threading

import rclpy
from example_interfaces.srv import Trigger
from rclpy.executors import MultiThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from std_msgs.msg import Int32


class InTimer(Node):
    def __init__(self):
        super().__init__("timer")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.divide(0)

    def divide(self, number):
        return 1 / number


class InSubscription(Node):
    def __init__(self):
        super().__init__("listener")
        publisher = self.create_publisher(Int32, "data", 10)
        self.create_subscription(Int32, "data", self.on_message, 10)
        self.create_timer(1.5, lambda: publisher.publish(Int32(data=3)))

    def on_message(self, msg):
        raise KeyError("speed")


class WithoutWords(InTimer):
    def tick(self):
        raise NotImplementedError()


class InInit(Node):
    def __init__(self):
        super().__init__("broken")
        self.value = self.missing


class WithoutSuper(Node):
    def __init__(self):
        self.create_timer(1.0, print)


class InService(Node):
    def __init__(self):
        super().__init__("server")
        self.create_service(Trigger, "trigger", self.answer)
        self.client = self.create_client(Trigger, "trigger")
        self.create_timer(1.0, lambda: self.client.call_async(Trigger.Request()))

    def answer(self, request, response):
        print(response.missing)
        return response


class ServiceThatReturnsNothing(InService):
    def answer(self, request, response):
        response.success = True


class InCoroutine(Node):
    def __init__(self):
        super().__init__("coroutine")
        self.create_timer(1.0, self.tick)

    async def tick(self):
        raise LookupError("not awaited")


class InTask(Node):
    def __init__(self):
        super().__init__("tasks")
        self.create_timer(1.0, lambda: self.executor.create_task(self.work))

    def work(self):
        raise OSError("no such device")


class Unready(LifecycleNode):
    def on_configure(self, state):
        return self.missing


def in_transition():
    """rclpy swallows the exception, and lets the node handle its error."""
    rclpy.init()
    node = Unready("unready")

    def configure():
        timer.cancel()
        node.get_logger().info(node.trigger_configure().name)

    timer = node.create_timer(0.5, configure)
    rclpy.spin(node)


def in_thread():
    rclpy.init()
    node = Node("threads")

    def work():
        raise KeyError("in thread")

    threading.Thread(target=work).start()
    node.create_timer(1.0, lambda: node.get_logger().info("tick"))
    rclpy.spin(node)


def in_parallel_callback():
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(InTimer())
    executor.spin()


def in_main():
    raise RuntimeError("at once")


def caught():
    """Catches its own exception, and goes on."""
    rclpy.init()
    node = InTimer()
    for _ in range(2):
        try:
            rclpy.spin(node)
        except ZeroDivisionError as error:
            node.get_logger().info(f"caught: {error}")


def chained():
    rclpy.init()
    try:
        int("x")
    except ValueError as error:
        raise RuntimeError("no number") from error


class Odd(Exception):
    """An exception with a text that fails."""

    def __str__(self):
        raise ValueError("no text")


def odd_exception():
    raise Odd


def init_twice():
    rclpy.init()
    rclpy.init()


def unknown_arguments():
    rclpy.init(args=["program", "--mine", "--ros-args", "--unknown", "-r", "a:=b", "--", "--mine"])


def another_domain():
    rclpy.init(domain_id=5)


def without_init():
    rclpy.spin(Node("forgot"))


def init_after_node():
    node = Node("early")
    rclpy.init()
    rclpy.spin(node)


def shutdown_twice():
    rclpy.init()
    rclpy.shutdown()
    rclpy.shutdown()


def own_context_shutdown_twice():
    context = rclpy.Context()
    rclpy.init(context=context)
    rclpy.try_shutdown(context=context)
    rclpy.try_shutdown(context=context)
    rclpy.shutdown(context=context)


def publish_after_shutdown():
    rclpy.init()
    publisher = Node("late").create_publisher(Int32, "data", 10)
    rclpy.shutdown()
    publisher.publish(Int32())


def node_after_shutdown():
    rclpy.init()
    rclpy.shutdown()
    Node("late")


def sys_exit():
    rclpy.init()
    sys.exit()


def sys_exit_with_a_status():
    rclpy.init()
    node = Node("leaver")
    node.create_timer(1.0, lambda: sys.exit(2))
    rclpy.spin(node)


def sys_exit_with_words():
    rclpy.init()
    sys.exit("bye")


def sys_exit_in_a_thread():
    rclpy.init()
    threading.Thread(target=sys.exit, args=(2,)).start()


def os_exit():
    rclpy.init()
    os._exit(0)


def os_exit_with_a_status():
    rclpy.init()
    os._exit(3)


def asks_the_keyboard():
    rclpy.init()
    Node("asker")
    input("Your name? ")


def events_executor():
    rclpy.init()
    EventsExecutor()


def spins_nothing():
    rclpy.init()
    rclpy.spin(None)


def starts_a_run():
    from sim import run

    run(InTimer)


def wrong_qos():
    rclpy.init()
    Node("qos").create_publisher(Int32, "data", "10")


def bad_topic_name():
    rclpy.init()
    Node("names").create_publisher(Int32, "my topic", 10)


def no_callback():
    """Calls the callback instead of naming it."""
    rclpy.init()
    node = Node("called")
    node.create_timer(1.0, node.get_name())
    rclpy.spin(node)


def timer_callback_with_argument():
    rclpy.init()
    node = Node("arguments")
    node.create_timer(1.0, lambda msg: None)
    rclpy.spin(node)


class Finished(Exception):
    """What a callback raises to end `spin()`."""


def finish():
    raise Finished


def catches_its_own_error():
    rclpy.init()
    node = Node("raises")
    node.create_timer(0.5, finish)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, Finished):
        node.get_logger().info("went on")


def suppresses_an_error_raised_on_purpose():
    rclpy.init()
    node = Node("raises")

    def tick():
        raise RuntimeError("enough")

    node.create_timer(0.5, tick)
    with contextlib.suppress(RuntimeError):
        rclpy.spin(node)
    node.get_logger().info("went on")


def catches_all_errors():
    rclpy.init()
    node = Node("raises")
    node.create_timer(0.5, finish)
    try:
        rclpy.spin(node)
    except Exception:
        node.get_logger().info("went on")


def catches_an_error_without_a_raise():
    rclpy.init()
    node = Node("raises")
    node.create_timer(0.5, lambda: 1 / 0)
    try:
        rclpy.spin(node)
    except ZeroDivisionError:
        node.get_logger().info("went on")


def raises_again():
    rclpy.init()
    node = Node("raises")
    node.create_timer(0.5, finish)
    try:
        rclpy.spin(node)
    except Finished:
        node.get_logger().info("went on")
        raise


def catches_what_a_thread_of_the_executor_raises():
    rclpy.init()
    node, executor = Node("raises"), MultiThreadedExecutor()
    node.create_timer(0.5, finish)
    executor.add_node(node)
    try:
        executor.spin()
    except Finished:
        node.get_logger().info("went on")


ON_PURPOSE = (
    *(catches_its_own_error, suppresses_an_error_raised_on_purpose),
    catches_what_a_thread_of_the_executor_raises,
)
def catches_the_same_elsewhere():
    rclpy.init()
    node = Node("raises")
    node.create_timer(0.5, finish)
    with contextlib.suppress(Finished):
        node.get_logger().info("went on", skip_first=True)
    try:
        rclpy.spin(node)
    finally:
        node.get_logger().info("went on")


CAUGHT = catches_the_same_elsewhere, catches_all_errors, catches_an_error_without_a_raise, raises_again


def needs_argument(robot):
    rclpy.init()
