"""Programs that are at work when the user interrupts them, some of which would rather not stop."""

import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node


class Busy(Node):
    """Computes for a long while in short callbacks."""

    def __init__(self):
        super().__init__("busy")
        self.create_timer(0.001, self.tick)

    def tick(self):
        sum(range(20_000))


class Swallower(Node):
    """Catches KeyboardInterrupt, as a careless `except` does."""

    def __init__(self):
        super().__init__("swallower")
        self.create_timer(1.0, self.tick)

    def tick(self):
        while True:
            try:
                sum(range(1000))
            except (Exception, KeyboardInterrupt):
                print("not me")


class SwallowsAll(Swallower):
    def tick(self):
        while True:
            try:
                sum(range(1000))
            except BaseException:
                print("not me")


def restarts_itself():
    """A main() that begins again whenever it is interrupted."""
    while True:
        try:
            rclpy.init()
            rclpy.spin(Busy())
        except KeyboardInterrupt:
            rclpy.try_shutdown()


def cleans_up():
    """Says goodbye when it is interrupted."""
    rclpy.init()
    node = Busy()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("goodbye")
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def sleeps():
    rclpy.init()
    while rclpy.ok():
        time.sleep(0.0001)


def leaves_threads_behind():
    """Its main() is interrupted; a pool without work, and a thread that waits, are not."""
    rclpy.init()
    node = Node("leaver")
    ThreadPoolExecutor(2).submit(print, "worked")

    def wait():
        try:
            time.sleep(1e6)
        except KeyboardInterrupt:
            print("interrupted", file=sys.stderr)
        finally:
            print("over", file=sys.stderr)

    threading.Thread(target=wait).start()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("goodbye")
