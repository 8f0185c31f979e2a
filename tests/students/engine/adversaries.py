"""Code that no tutorial shows and some student writes all the same."""

import asyncio
import contextlib
import io
import multiprocessing
import os
import sys
import threading
import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_msgs.msg import Int32


class Ticking(Node):
    """What the others are built on: a timer that calls `tick` after 1 s."""

    def __init__(self):
        super().__init__("ticking")
        self.publisher = self.create_publisher(Int32, "count", 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().info("tick")


class DestroysItself(Ticking):
    def tick(self):
        super().tick()
        self.destroy_node()


class StopsItsExecutor(Ticking):
    def tick(self):
        super().tick()
        self.executor.shutdown()


class SpinsInInit(Ticking):
    def __init__(self):
        super().__init__()
        rclpy.spin(self)


class SpinsOnceInCallback(Ticking):
    def tick(self):
        super().tick()
        rclpy.spin_once(self, timeout_sec=0.1)
        self.get_logger().info("spun")


class SleepsByRateInCallback(Ticking):
    """A rate needs another thread to wake it."""

    def tick(self):
        self.create_rate(10).sleep()


class ForksByMultiprocessing(Ticking):
    def tick(self):
        process = multiprocessing.get_context("fork").Process(target=print, args=("child",))
        process.start()
        process.join()
        self.get_logger().info(f"exit code {process.exitcode}")


class Forks(Ticking):
    def tick(self):
        if os.fork() == 0:
            os._exit(0)
        os.wait()
        super().tick()


class AwaitsAsyncio(Ticking):
    async def tick(self):
        await asyncio.sleep(0.5)


class DestroyRaises(Ticking):
    def destroy_node(self):
        raise ZeroDivisionError("in destroy_node")


class DestroyTimerRaises(Ticking):
    def destroy_timer(self, timer):
        raise ZeroDivisionError("in destroy_timer")


class DestroyTimerRaisesInSlots(DestroyTimerRaises):
    __slots__ = ("speed",)


class DestroyForgetsSuper(Ticking):
    def destroy_node(self):
        self.get_logger().info("not today")


class DestroyHangs(Ticking):
    def destroy_node(self):
        while True:
            pass


class DelRaises(Ticking):
    def __del__(self):
        raise ZeroDivisionError("in __del__")


class PublishesText(Ticking):
    def tick(self):
        self.publisher.publish("seven")


class RedirectsStdout(Ticking):
    """Never puts it back."""

    def tick(self):
        sys.stdout = io.StringIO()
        print("no one receives this")


class ClosesStdout(Ticking):
    def tick(self):
        sys.stdout.close()
        print("still there")


class ClosesStderr(Ticking):
    def tick(self):
        os.close(2)
        super().tick()


class PrintsBytes(Ticking):
    def tick(self):
        sys.stdout.buffer.write(b"bytes\n")
        sys.stdout.flush()
        print(sys.stdout.encoding, sys.stdout.isatty())


class SleepsOddly(Ticking):
    def tick(self):
        for seconds in (0, 0.0, True):
            time.sleep(seconds)
        for seconds in (-1, "1", float("nan"), float("inf"), None):
            try:
                time.sleep(seconds)
            except (ValueError, TypeError, OverflowError) as error:
                self.get_logger().info(type(error).__name__)


class NanosecondTimer(Ticking):
    def tick(self):
        self.create_timer(1e-9, lambda: None)


class SlowByALittle(Node):
    """Computes a little in each of very many callbacks."""

    def __init__(self):
        super().__init__("slow")
        self.create_timer(0.0001, lambda: sum(range(1_000_000)))


class Camera(Node):
    """Ten pictures of a megabyte a second."""

    def __init__(self):
        super().__init__("camera")
        publisher = self.create_publisher(Image, "image", 10)
        picture = Image(width=640, height=480, encoding="rgb8", step=1920, data=bytes(1_000_000))
        self.create_timer(0.1, lambda: publisher.publish(picture))


class ReplacesSleep(Ticking):
    """Puts its own function in place of time.sleep, and puts it back."""

    def tick(self):
        kept, time.sleep = time.sleep, lambda seconds: None
        time.sleep(100)
        time.sleep = kept
        super().tick()


class UsesRosNamesForItself(Ticking):
    """Attributes that rclpy's Node has too."""

    def __init__(self):
        super().__init__()
        for name in ("timers", "publishers", "subscriptions", "clients", "services", "context", "handle"):
            with contextlib.suppress(AttributeError):
                setattr(self, name, [])


class ExitsInThread(Ticking):
    def tick(self):
        threading.Thread(target=sys.exit, args=(1,)).start()
        super().tick()


class RaisesKeyboardInterrupt(Ticking):
    def tick(self):
        raise KeyboardInterrupt


class RaisesGeneratorExit(Ticking):
    def tick(self):
        raise GeneratorExit


class RaisesBaseException(Ticking):
    def tick(self):
        raise BaseException("bare")


class MeddlesWithTheTrace(Ticking):
    def tick(self):
        sys.settrace(lambda *arguments: None)
        sys.setrecursionlimit(5000)
        super().tick()


def exits_in_parallel():
    class Exits(Ticking):
        def tick(self):
            sys.exit()

    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(Exits())
    executor.spin()


def leaves_everything():
    """Makes nodes and threads, and returns at once."""
    rclpy.init()
    nodes = [Ticking() for _ in range(5)]
    threading.Thread(target=rclpy.spin, args=(nodes[0],)).start()


def shutdown_in_another_thread():
    rclpy.init()
    threading.Timer(1.5, rclpy.shutdown).start()
    node = Ticking()
    try:
        rclpy.spin(node)
    except rclpy.executors.ExternalShutdownException:
        node.get_logger().info("outside")


def endless_generator():
    rclpy.init()
    return (number for number in iter(int, 1))


async def coroutine_main():
    rclpy.init()
    Ticking()


def returns_two_nodes():
    rclpy.init()
    return Ticking(), Ticking()
