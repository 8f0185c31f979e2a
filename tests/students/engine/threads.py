"""Threads, locks, queues and pools in student code."""

import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class Reporter(Node):
    """Says in its log who did what."""

    def __init__(self):
        super().__init__("reporter")

    def say(self, text):
        self.get_logger().info(text)


def spin_in_a_thread():
    """main() works while a thread spins; it ends the thread by shutting down."""
    rclpy.init()
    node = Reporter()
    node.create_timer(0.5, lambda: node.say("tick"))
    thread = threading.Thread(target=rclpy.spin, args=(node,))
    thread.start()
    time.sleep(1.25)
    node.say(f"alive {thread.is_alive()}")
    rclpy.shutdown()
    thread.join()
    node.say(f"alive {thread.is_alive()}")


def executor_in_a_thread():
    rclpy.init()
    node = Reporter()
    node.create_timer(0.5, lambda: node.say("tick"))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    time.sleep(1.25)
    executor.shutdown()
    thread.join(timeout=1.0)
    node.say(f"alive {thread.is_alive()}")


class ThreadSubclass(threading.Thread):
    def __init__(self, node):
        super().__init__(daemon=True)
        self.node = node

    def run(self):
        for number in range(3):
            time.sleep(0.5)
            self.node.say(f"work {number}")


def thread_subclass():
    rclpy.init()
    node = Reporter()
    worker = ThreadSubclass(node)
    worker.start()
    worker.join(0.75)
    node.say("joined for 0.75 s")
    worker.join()
    node.say("joined")


def thread_made_by_the_node():
    """A thread started in a callback, as one does for slow work."""
    rclpy.init()
    node = Reporter()

    def work():
        time.sleep(1.0)
        node.say("done")

    def once():
        timer.cancel()
        threading.Thread(target=work).start()
        node.say("started")

    timer = node.create_timer(0.5, once)
    node.create_timer(0.5, lambda: node.say("tick"))
    rclpy.spin(node)


def lock_across_sleeps():
    """Two callbacks of a reentrant group share a lock: one waits while the other holds it."""
    rclpy.init()
    node, lock, group = Reporter(), threading.Lock(), ReentrantCallbackGroup()

    def hold(name, seconds):
        with lock:
            node.say(f"{name} in")
            time.sleep(seconds)
            node.say(f"{name} out")

    for name, seconds in (("a", 0.4), ("b", 0.3)):
        node.create_timer(1.0, lambda n=name, s=seconds: hold(n, s), callback_group=group)
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()


def all_primitives():
    """Event, Condition, Semaphore, Barrier, RLock, Timer: one thread does, the other waits."""
    rclpy.init()
    node = Reporter()
    event, condition, semaphore = threading.Event(), threading.Condition(), threading.Semaphore(0)
    barrier, rlock = threading.Barrier(2), threading.RLock()

    def other():
        time.sleep(0.5)
        event.set()
        time.sleep(0.5)
        with condition:
            condition.notify()
        time.sleep(0.5)
        semaphore.release()
        time.sleep(0.5)
        barrier.wait()
        with rlock, rlock:
            time.sleep(0.5)

    threading.Thread(target=other).start()
    node.say(f"early {event.wait(timeout=0.25)}")
    node.say(f"event {event.wait()}")
    with condition:
        node.say(f"condition {condition.wait(timeout=2)}")
    node.say(f"semaphore {semaphore.acquire(timeout=2)}")
    barrier.wait()
    node.say("barrier")
    time.sleep(0.1)
    node.say(f"rlock at once {rlock.acquire(blocking=False)}")
    with rlock:
        node.say("rlock")
    threading.Timer(0.5, lambda: node.say("timer")).start()


def queues():
    """A callback feeds a slow worker through a queue."""
    rclpy.init()
    node, work = Reporter(), queue.Queue()

    def worker():
        while True:
            item = work.get()
            time.sleep(0.25)
            node.say(f"did {item}")
            work.task_done()

    threading.Thread(target=worker, daemon=True).start()
    numbers = iter(range(100))
    node.create_timer(1.0, lambda: work.put(next(numbers)))
    rclpy.spin(node)


def queue_timeout():
    rclpy.init()
    node = Reporter()
    try:
        queue.Queue().get(timeout=1.5)
    except queue.Empty:
        node.say("empty")


def semaphore_timeout():
    rclpy.init()
    node = Reporter()
    node.say(str(threading.Semaphore(0).acquire(timeout=1.5)))
    condition = threading.Condition()
    with condition:
        node.say(str(condition.wait_for(lambda: False, timeout=1.5)))


def pool():
    rclpy.init()
    node = Reporter()

    def work(seconds):
        time.sleep(seconds)
        return seconds

    with ThreadPoolExecutor(2) as executor:
        for result in executor.map(work, (1.0, 0.5, 0.25)):
            node.say(f"result {result}")
    node.say("closed")


def thread_local_storage():
    """Each thread has its own `threading.local`."""
    rclpy.init()
    node, own = Reporter(), threading.local()
    own.name = "main"

    def other():
        node.say(f"other has {getattr(own, 'name', 'nothing')}")
        own.name = "other"
        time.sleep(0.5)
        node.say(f"other has {own.name}")

    thread = threading.Thread(target=other)
    thread.start()
    time.sleep(0.25)
    node.say(f"main has {own.name}")
    thread.join()


def thread_names():
    rclpy.init()
    node = Reporter()

    def other():
        node.say(threading.current_thread().name)

    thread = threading.Thread(target=other, name="worker")
    thread.start()
    thread.join()


def names_that_python_gives():
    """Two threads and a pool, without a name from anybody; then callbacks in parallel."""
    rclpy.init()
    node, group = Reporter(), ReentrantCallbackGroup()

    def work(seconds=0.0):
        node.say(threading.current_thread().name)
        time.sleep(seconds)
        assert threading.current_thread().is_alive()

    for _ in range(2):
        threading.Thread(target=work).start()
    with ThreadPoolExecutor(1) as workers:
        workers.submit(work)
    node.create_timer(1.0, lambda: work(0.6), callback_group=group)
    node.create_timer(1.25, work, callback_group=group)
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    executor.spin()


def groups(executor_class, group_class):
    """A program in which two timers sleep 0.5 s each second, in one group of this kind."""

    def main():
        rclpy.init()
        node, group = Reporter(), group_class()

        def sleeper(name):
            def callback():
                node.say(f"{name} in")
                time.sleep(0.5)
                node.say(f"{name} out")

            return callback

        for name in "ab":
            node.create_timer(1.0, sleeper(name), callback_group=group)
        executor = executor_class()
        executor.add_node(node)
        executor.spin()

    return main


single_exclusive = groups(SingleThreadedExecutor, MutuallyExclusiveCallbackGroup)
single_reentrant = groups(SingleThreadedExecutor, ReentrantCallbackGroup)
multi_exclusive = groups(MultiThreadedExecutor, MutuallyExclusiveCallbackGroup)
multi_reentrant = groups(MultiThreadedExecutor, ReentrantCallbackGroup)


def two_groups_in_parallel():
    """Each exclusive group has its own turn: the slow one doesn't hold up the fast one."""
    rclpy.init()
    node = Reporter()
    slow, fast = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()

    def sleep():
        time.sleep(0.9)
        node.say("slow")

    node.create_timer(1.0, sleep, callback_group=slow)
    node.create_timer(0.5, lambda: node.say("fast"), callback_group=fast)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


def more_work_than_threads():
    """Three callbacks of 0.5 s, two threads."""
    rclpy.init()
    node, group = Reporter(), ReentrantCallbackGroup()

    def sleeper(name):
        def callback():
            time.sleep(0.5)
            node.say(name)

        return callback

    for name in "abc":
        node.create_timer(2.0, sleeper(name), callback_group=group)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()
