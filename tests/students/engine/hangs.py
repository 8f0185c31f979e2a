"""Nodes that never come to an end, each in another way. All do it in a timer after 1 s."""

import contextlib
import os
import queue
import select
import sys
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger


class Hanging(Node):
    """What the others are built on: a timer that calls `tick` after 1 s."""

    def __init__(self):
        super().__init__("hanging")
        self.publisher = self.create_publisher(Int32, "data", 10)
        self.create_timer(1.0, self.tick)


class Loop(Hanging):
    def tick(self):
        while True:
            pass


class LoopThatSwallows(Hanging):
    """Nothing that is raised in it gets out."""

    def tick(self):
        while True:
            try:
                while True:
                    pass
            except BaseException:
                pass


class LoopThatSwallowsExceptions(Hanging):
    def tick(self):
        while True:
            try:
                sum(range(10))
            except Exception:
                print("never mind")


class LoopInMain:
    @staticmethod
    def main():
        rclpy.init()
        while True:
            pass


class LoopInInit(Node):
    def __init__(self):
        super().__init__("hanging")
        while True:
            pass


class LoopWithPrint(Hanging):
    def tick(self):
        while True:
            print("still here")


class LoopWithLog(Hanging):
    def tick(self):
        while True:
            self.get_logger().info("still here")


class Recursion(Hanging):
    def tick(self):
        self.tick()


class Sleep(Hanging):
    """Sleeps until long after the run: slow, and no hang."""

    def tick(self):
        time.sleep(1e5)


class SleepLoop(Hanging):
    def tick(self):
        while True:
            time.sleep(0.1)


class Lock(Hanging):
    """Takes the same lock twice."""

    def tick(self):
        lock = threading.Lock()
        with lock, lock:
            pass


class EventNoOneSets(Hanging):
    def tick(self):
        threading.Event().wait()


class EmptyQueue(Hanging):
    def tick(self):
        queue.Queue().get()


class JoinsItself(Hanging):
    def tick(self):
        thread = threading.Thread(target=lambda: threading.Event().wait())
        thread.start()
        thread.join()


class Pipe(Hanging):
    """A call into the system that no one answers."""

    def tick(self):
        read, write = os.pipe()
        try:
            os.read(read, 1)
        finally:
            os.close(read)
            os.close(write)


class WaitsForASecond(Hanging):
    """A call into the system that takes a second of real time, once."""

    waited = False

    def tick(self):
        if not self.waited:
            self.waited = True
            select.poll().poll(1000)


class WaitsALittle(Hanging):
    """A thread that waits in the operating system again and again, each time for 20 ms of real time."""

    def tick(self):
        threading.Thread(target=self.work).start()

    def work(self):
        while True:
            select.poll().poll(20)
            time.sleep(0.0001)


class PingPong(Hanging):
    """Answers its own message at once, forever."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Int32, "data", self.publisher.publish, 10)

    def tick(self):
        self.publisher.publish(Int32())


def swallows_ping_pong():
    """Has PingPong, and lets no exception pass."""
    rclpy.init()
    node = PingPong()
    while True:
        with contextlib.suppress(BaseException):
            rclpy.spin_once(node)


class GuardCondition(Hanging):
    """Triggers itself, forever."""

    def tick(self):
        self.guard = self.create_guard_condition(lambda: self.guard.trigger())
        self.guard.trigger()


class TaskThatMakesTasks(Hanging):
    def tick(self):
        self.executor.create_task(self.tick)


class ZeroTimer(Hanging):
    """A timer with no period."""

    def tick(self):
        self.create_timer(0.0, lambda: None)


class AsksForEver(Hanging):
    """Waits for an answer that doesn't come, in a loop that no exception leaves."""

    def __init__(self):
        super().__init__()
        self.client = self.create_client(Trigger, "absent")

    async def tick(self):
        while True:
            with contextlib.suppress(BaseException):
                await self.client.call_async(Trigger.Request())


def asks_in_a_program_that_ends():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(AsksForEver())
    end = time.monotonic() + 1.5
    while time.monotonic() < end:
        executor.spin_once(timeout_sec=0.5)


class Allocates(Hanging):
    """Fills the memory, slowly enough to be stopped."""

    def tick(self):
        kept = []
        while True:
            kept.append(sys.getsizeof(kept))
            if len(kept) > 1000:
                kept.clear()
