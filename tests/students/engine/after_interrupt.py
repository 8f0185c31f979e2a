"""Programs that print what still works after Ctrl-C; on the command line: python after_interrupt.py NAME."""

import sys
import threading
import time
from functools import partial

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32


class Counter(Node):
    """Publishes at 20 Hz, and reports once that it is at work."""

    def __init__(self, **options):
        super().__init__("counter", **options)
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.client = self.create_client(AddTwoInts, "add")
        self.declare_parameter("known", 1)
        self.create_timer(0.05, self.tick)

    def tick(self):
        self.publisher.publish(Int32())


def line(*words):
    """Print a line in one piece: another thread's line doesn't come into it."""
    print(" ".join(map(str, words)) + "\n", end="")


def attempt(name, function):
    """Print what a call returns or raises, without the place in rcl's sources."""
    try:
        result = function()
        line(name, "gives", result if isinstance(result, bool | int | list) else type(result).__name__)
    except Exception as error:
        line(name, "raises", type(error).__name__, str(error).split(", at ")[0])


def attempts(node, context=None):
    """What a program may do in `finally`."""
    called = []
    (context or rclpy.get_default_context()).on_shutdown(partial(called.append, 1))
    publish = partial(node.publisher.publish, Int32())
    return {
        "ok": lambda: rclpy.ok(context=context),
        "publish": publish,
        "log": lambda: node.get_logger().info("still here"),
        "create_publisher": lambda: node.create_publisher(Int32, "other", 10),
        "create_subscription": lambda: node.create_subscription(Int32, "other", print, 10),
        "create_timer": lambda: node.create_timer(1.0, print),
        "create_client": lambda: node.create_client(AddTwoInts, "other"),
        "create_service": lambda: node.create_service(AddTwoInts, "another", print),
        "create_rate": lambda: node.create_rate(10),
        "Node": lambda: Node("another", context=context),
        "call_async": lambda: node.client.call_async(AddTwoInts.Request()),
        "service_is_ready": node.client.service_is_ready,
        "wait_for_service": lambda: node.client.wait_for_service(0.1),
        "get_topic_names_and_types": lambda: len(node.get_topic_names_and_types()) > 0,
        "get_node_names": node.get_node_names,
        "count_subscribers": lambda: node.count_subscribers("count"),
        "count_publishers": lambda: node.count_publishers("count"),
        "get_subscription_count": node.publisher.get_subscription_count,
        "get_publishers_info_by_topic": lambda: len(node.get_publishers_info_by_topic("count")),
        "get_parameter": lambda: node.get_parameter("known").value,
        "declare_parameter": lambda: node.declare_parameter("new", 1),
        "set_parameters": lambda: node.set_parameters([Parameter("known", value=2)]),
        "now": lambda: node.get_clock().now().nanoseconds > 0,
        "sleep_for": lambda: node.get_clock().sleep_for(Duration(seconds=0.1)),
        "spin_once": lambda: rclpy.spin_once(node, timeout_sec=0.1),
        "spin": lambda: rclpy.spin(node),
        "destroy_node": node.destroy_node,
        "shutdown": lambda: rclpy.shutdown(context=context),
        "shutdown again": lambda: rclpy.shutdown(context=context),
        "try_shutdown": lambda: rclpy.try_shutdown(context=context),
        "on_shutdown": lambda: called,
        "init": rclpy.init,
        "ok after init": rclpy.ok,
    }


def interrupted(name, node, work, context=None, few=True):
    """Do this until Ctrl-C; then print which exception that is, and what still works."""
    tries = attempts(node, context)
    if few:
        tries = {name: tries[name] for name in ("ok", "publish", "shutdown", "shutdown again", "on_shutdown")}
    try:
        threading.Timer(0.3, print, ["ready"], {"flush": True}).start()
        work(node)
        line(name, "ended")
    except KeyboardInterrupt:
        line(name, "was interrupted")
    finally:
        time.sleep(0.2)  # rclpy's own handler works in a thread of its own
        for each, function in tries.items():
            attempt(each, function)


def spins():
    rclpy.init()
    interrupted("spin", Counter(), rclpy.spin, few=False)


def sigint_only():
    rclpy.init(signal_handler_options=SignalHandlerOptions.SIGINT)
    interrupted("SIGINT", Counter(), rclpy.spin)


def no_handlers():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    interrupted("NO", Counter(), rclpy.spin)


def sigterm_only():
    rclpy.init(signal_handler_options=SignalHandlerOptions.SIGTERM)
    interrupted("SIGTERM", Counter(), rclpy.spin)


def own_context():
    context = Context()
    rclpy.init(context=context)
    executor = SingleThreadedExecutor(context=context)

    def work(node):
        executor.add_node(node)
        executor.spin()

    interrupted("a context of its own", Counter(context=context), work, context)


def second_context():
    rclpy.init()
    own_context()


def shut_down_before():
    rclpy.init()
    rclpy.shutdown()
    own_context()


def multi_threaded():
    rclpy.init()
    interrupted("threads", Counter(), lambda node: rclpy.spin(node, MultiThreadedExecutor(2)))


def loops():
    rclpy.init()

    def work(node):
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.01)

    interrupted("a loop", Counter(), work)


def waits_for_a_future():
    rclpy.init()
    interrupted("a future", Counter(), lambda node: rclpy.spin_until_future_complete(node, Future()))


def waits_for_a_message():
    rclpy.init()
    interrupted("a message", Counter(), lambda node: wait_for_message(Int32, node, "silence"))


def waits_for_a_service():
    rclpy.init()
    interrupted("a service", Counter(), lambda node: node.client.wait_for_service())


def spins_in_a_thread():
    rclpy.init()

    def work(node):
        thread = threading.Thread(target=quiet_spin, args=(node,), daemon=True)
        thread.start()
        try:
            time.sleep(1e5)
        finally:
            thread.join()
            line("the thread has ended")

    interrupted("a thread", Counter(), work)


def quiet_spin(node):
    try:
        rclpy.spin(node)
    except rclpy.executors.ExternalShutdownException:
        line("shut down from outside")


def sleeps_at_a_rate():
    rclpy.init()

    def work(node):
        thread = threading.Thread(target=quiet_spin, args=(node,), daemon=True)
        thread.start()
        rate = node.create_rate(2)
        try:
            while rclpy.ok():
                rate.sleep()
        finally:
            thread.join()

    interrupted("a rate", Counter(), work)


def shuts_down_again():
    rclpy.init()
    node = Counter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.shutdown()


def publishes_at_the_end():
    rclpy.init()
    node = Counter()
    try:
        rclpy.spin(node)
    finally:
        node.publisher.publish(Int32())


def pauses_at_the_end():
    rclpy.init()
    try:
        rclpy.spin(Counter())
    except KeyboardInterrupt:
        time.sleep(1.5)
        raise ValueError("after the pause") from None


class Impatient(Counter):
    """Ends itself, as Ctrl-C would."""

    def tick(self):
        super().tick()
        raise KeyboardInterrupt


def interrupts_itself():
    rclpy.init()
    rclpy.spin(Impatient())


def says_goodbye():
    rclpy.init()
    node = Counter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("interrupted")
    finally:
        time.sleep(0.5)
        node.get_logger().warning("goodbye")


def never_ends():
    rclpy.init()
    while True:
        try:
            time.sleep(1.0)
        except KeyboardInterrupt:
            time.sleep(5.0)
            raise ValueError("too late") from None


PROGRAMS = (
    *(spins, sigint_only, no_handlers, sigterm_only, own_context, second_context, shut_down_before),
    *(multi_threaded, loops, waits_for_a_future, waits_for_a_message, waits_for_a_service),
    *(spins_in_a_thread, sleeps_at_a_rate),
)

if __name__ == "__main__":
    globals()[sys.argv[1]]()
