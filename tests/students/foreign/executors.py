"""Programs that spin in other ways: several executors, tasks, futures, asyncio, pools of threads."""

import asyncio
import contextlib
import threading
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int64, String

QUIET = contextlib.suppress(KeyboardInterrupt, ExternalShutdownException)


class Talker(Node):
    def __init__(self, name="talker", **more):
        super().__init__(name, **more)
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        self.publisher.publish(String(data=self.get_name()))


class Listener(Node):
    def __init__(self, name="listener", **more):
        super().__init__(name, **more)
        self.count = 0
        self.create_subscription(String, "chatter", self.receive, 10)

    def receive(self, message):
        self.count += 1


def three_in_one_executor():
    rclpy.init()
    executor = SingleThreadedExecutor()
    nodes = [Talker("left"), Talker("right"), Listener()]
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        for node in nodes:
            node.destroy_node()


def an_executor_for_each_node():
    """Each thread has an executor of its own."""
    rclpy.init()
    for node in (Talker(), Listener("one")):
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        threading.Thread(target=executor.spin, daemon=True).start()
    with QUIET:
        rclpy.spin(Listener("two"))


def same_name_in_two_namespaces():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    for namespace in ("left", "right"):
        executor.add_node(Talker("camera", namespace=namespace))
        executor.add_node(Listener("viewer", namespace=namespace))
    with QUIET:
        executor.spin()


def spins_until_a_future_is_done():
    """A future is its signal to end; then it ends."""
    rclpy.init()
    node, done = Talker(), Future()
    node.create_timer(1.0, lambda: done.done() or done.set_result("enough"))
    rclpy.spin_until_future_complete(node, done)
    node.destroy_node()
    rclpy.shutdown()


def spins_in_steps():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Talker())
    executor.add_node(Listener())
    with QUIET:
        while rclpy.ok():
            executor.spin_once(timeout_sec=0.5)


def has_a_task():
    """A coroutine is a task of the executor, and awaits futures that a timer completes."""
    rclpy.init()
    node = Node("tasks")
    publisher = node.create_publisher(Int64, "count", 10)
    pending = []

    async def count():
        for number in range(5):
            pending.append(Future())
            await pending[-1]
            publisher.publish(Int64(data=number))

    node.create_timer(0.2, lambda: pending and not pending[-1].done() and pending[-1].set_result(True))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.create_task(count())
    with QUIET:
        executor.spin()


def beside_asyncio():
    """asyncio has the main loop, and spins in between."""

    async def main():
        rclpy.init()
        node = Talker()
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.0)
            await asyncio.sleep(0.05)

    with QUIET:
        asyncio.run(main())


def spins_in_a_thread_of_asyncio():
    async def main():
        rclpy.init()
        node = Node("asynchronous")
        publisher = node.create_publisher(String, "chatter", 10)
        threading.Thread(target=spin, args=(node,), daemon=True).start()
        for number in range(6):
            publisher.publish(String(data=str(number)))
            await asyncio.sleep(0.2)

    asyncio.run(main())


def spin(node):
    with QUIET:
        rclpy.spin(node)


class Pooled(Node):
    """Hands its work to a pool, whose threads publish the results."""

    def __init__(self):
        super().__init__("pooled")
        self.pool = ThreadPoolExecutor(max_workers=2)
        self.publisher = self.create_publisher(Int64, "length", 10)
        self.create_subscription(String, "chatter", self.receive, 10)

    def receive(self, message):
        self.pool.submit(self.work, message.data)

    def work(self, text):
        self.publisher.publish(Int64(data=len(text)))


class Groups(Node):
    """Callback groups in all kinds, which the default executor ignores."""

    def __init__(self):
        super().__init__("groups")
        reentrant, exclusive = ReentrantCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.publisher = self.create_publisher(Int64, "count", 10, callback_group=exclusive)
        self.create_subscription(String, "chatter", self.receive, 10, callback_group=reentrant)
        self.create_timer(0.3, self.tick, callback_group=exclusive)
        self.count = 0

    def receive(self, message):
        self.count += 1

    def tick(self):
        self.publisher.publish(Int64(data=self.count))


class AwaitsAThread(Node):
    """Cancels its timer, and awaits what a thread completes much later."""

    def __init__(self):
        super().__init__("awaits_a_thread")
        self.timer = self.create_timer(0.1, self.work)

    async def work(self):
        self.timer.cancel()
        future = Future()
        threading.Timer(1.5, future.set_result, ["measured"]).start()
        self.get_logger().info(await future)


class SteadyTimer(Node):
    """A timer of the steady clock; a guard condition triggers the message."""

    def __init__(self):
        super().__init__("steady")
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.guard = self.create_guard_condition(self.triggered)
        self.create_timer(0.3, self.guard.trigger, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def triggered(self):
        self.publisher.publish(String(data="triggered"))


class RestartsItsTimer(Node):
    """A watchdog: each message resets the timer, so it fires only in silence."""

    def __init__(self):
        super().__init__("watchdog")
        self.timer = self.create_timer(0.5, self.silent)
        self.create_subscription(String, "chatter", lambda _: self.timer.reset(), 10)

    def silent(self):
        self.get_logger().warning("silence")


def uses_the_global_executor():
    rclpy.init()
    executor = rclpy.get_global_executor()
    executor.add_node(Talker())
    executor.add_node(Listener())
    with QUIET:
        executor.spin()


CORPUS = [
    (three_in_one_executor,),
    (an_executor_for_each_node,),
    (same_name_in_two_namespaces,),
    (spins_until_a_future_is_done, Listener),
    (spins_in_steps,),
    (has_a_task,),
    (beside_asyncio, Groups),
    (spins_in_a_thread_of_asyncio, Pooled),
    (SteadyTimer, RestartsItsTimer),
    (uses_the_global_executor,),
    (AwaitsAThread,),
]
