"""Two threads find the same finished job, and both remove it (as in rclpy#1477)."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Jobs(Node):
    """One timer adds jobs, and two others remove those that are finished."""

    def __init__(self):
        super().__init__("jobs")
        self.jobs = []
        group = ReentrantCallbackGroup()
        self.create_timer(0.1, self.add, callback_group=group)
        for _ in range(2):
            self.create_timer(0.1, self.clean, callback_group=group)

    def add(self):
        self.jobs.append({"finished": True})

    def clean(self):
        for job in list(self.jobs):
            if job["finished"] and job in self.jobs:
                self.jobs.remove(job)


class TakesFirst(Jobs):
    """Takes a job from the list, which only one thread can, and looks at it then."""

    def clean(self):
        while self.jobs:
            try:
                job = self.jobs.pop()
            except IndexError:
                return
            assert job["finished"]


def spun(node):
    """A main() that spins a node with three threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(3)
        executor.add_node(node())
        executor.spin()

    return main


WRONG, RIGHT = (spun(Jobs),), (spun(TakesFirst),)
