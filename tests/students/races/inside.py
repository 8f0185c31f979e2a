"""Racy programs that are defined inside functions, each with a right twin."""

import functools
import threading
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


def counter(locked):
    """A main() whose class is in the same function: two threads count with one number."""

    class Counter(Node):
        def __init__(self):
            super().__init__("counter")
            self.count, self.lock = 0, threading.Lock()
            self.workers = [threading.Thread(target=self.work) for _ in range(2)]
            for worker in self.workers:
                worker.start()
            self.create_timer(0.5, self.look)

        def work(self):
            for _ in range(10):
                if locked:
                    with self.lock:
                        self.increment()
                else:
                    self.increment()
                time.sleep(0.01)

        def increment(self):
            count = self.count
            self.count = count + 1

        def look(self):
            assert any(worker.is_alive() for worker in self.workers) or self.count == 20

    def main():
        rclpy.init()
        rclpy.spin(Counter())

    return main


def jobs(copied):
    """A main() whose thread is a closure: it looks whether there is a job, and then takes it."""

    def main():
        rclpy.init()
        node, box = Node("jobs"), {"job": None}

        def change():
            box["job"] = None if box["job"] else "sweep"

        def take():
            job = box["job"] if copied else None
            if copied:
                return job and job.upper()
            if box["job"] is not None:
                return box["job"].upper()
            return None

        def work():
            while rclpy.ok():
                take()
                time.sleep(0.005)

        node.create_timer(0.02, change)
        threading.Thread(target=work, daemon=True).start()
        rclpy.spin(node)

    return main


def locks(one_order):
    """A main() with two locks: two lambdas take them, in different orders."""

    def main():
        rclpy.init()
        node, (a, b), done = Node("locks"), (threading.Lock(), threading.Lock()), []

        def work(first, second):
            for _ in range(5):
                with first:
                    time.sleep(0.001)
                    with second:
                        done.append(1)
                time.sleep(0.01)

        for target in (lambda: work(a, b), lambda: work(a, b) if one_order else work(b, a)):
            threading.Thread(target=target, daemon=True).start()
            time.sleep(0.05 if not one_order else 0)

        def look():
            assert len(done) == 10

        node.create_timer(1.5, look)
        rclpy.spin(node)

    return main


def waiting(cleared_first):
    """A main() whose thread asks, and then clears the event that the answer sets: a lost wake-up."""

    def main():
        rclpy.init()
        node, event, done = Node("asks"), threading.Event(), []
        publisher = node.create_publisher(Int32, "ask", 10)
        node.create_subscription(Int32, "answer", lambda message: event.set(), 10)

        def ask(number):
            if cleared_first:
                event.clear()
            publisher.publish(Int32(data=number))
            if not cleared_first:
                event.clear()
            event.wait()
            done.append(number)

        def work():
            while not (publisher.get_subscription_count() and node.count_publishers("answer")):
                time.sleep(0.1)
            time.sleep(0.1)
            for number in range(3):
                ask(number)

        def look():
            assert len(done) == 3

        threading.Thread(target=work, daemon=True).start()
        node.create_timer(1.9, look)
        rclpy.spin(node)

    return main


def answers():
    """A main() that answers each number with itself."""
    rclpy.init()
    node = Node("answers")
    publisher = node.create_publisher(Int32, "answer", 10)
    node.create_subscription(Int32, "ask", publisher.publish, 10)
    rclpy.spin(node)


def decorated(locked):
    """A main() behind a decorator, with a shared number of the function around it."""

    def logged(function):
        @functools.wraps(function)
        def call(*arguments):
            return function(*arguments)

        return call

    @logged
    def main():
        rclpy.init()
        node, lock, total = Node("decorated"), threading.Lock(), 0

        @logged
        def add():
            nonlocal total
            before = total
            total = before + 1

        def work():
            for _ in range(10):
                if locked:
                    with lock:
                        add()
                else:
                    add()
                time.sleep(0.01)

        workers = [threading.Thread(target=work) for _ in range(2)]
        for worker in workers:
            worker.start()

        def look():
            assert any(worker.is_alive() for worker in workers) or total == 20

        node.create_timer(0.5, look)
        rclpy.spin(node)

    return main


PROGRAMS = {
    "lost update": ((counter(False),), (counter(True),)),
    "check, then act": ((jobs(False),), (jobs(True),)),
    "two locks": ((locks(False),), (locks(True),)),
    "lost wake-up": ((waiting(False), answers), (waiting(True), answers)),
    "decorated": ((decorated(False),), (decorated(True),)),
}
