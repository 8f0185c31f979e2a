"""A loop ends before the error of the last task is looked at (as in rclpy#1659)."""

import threading
import time

from rclpy.node import Node
from std_msgs.msg import String


class Batch(Node):
    """A thread does tasks; another one watches it, and reports how the batch ended."""

    def __init__(self):
        super().__init__("batch")
        self.error, self.busy = None, True
        self.publisher = self.create_publisher(String, "report", 10)
        threading.Thread(target=self.work, daemon=True).start()
        threading.Thread(target=self.watch, daemon=True).start()

    def work(self):
        for _ in range(10):
            time.sleep(0.0513)
        try:
            raise OSError("the gripper is stuck")
        except OSError as error:
            self.error = error
        self.busy = False

    def watch(self):
        while True:
            if self.error is not None:
                self.report(f"failed: {self.error}")
                return
            if not self.busy:
                break
            time.sleep(0.01)
        self.report("done")

    def report(self, text):
        self.publisher.publish(String(data=text))


class LooksOnceMore(Batch):
    """Looks at the error after the end, too."""

    def watch(self):
        while self.busy and self.error is None:
            time.sleep(0.01)
        self.report("done" if self.error is None else f"failed: {self.error}")


def holds(run):
    """It reports the error."""
    return [message.message.data for message in run.messages("/report")] == ["failed: the gripper is stuck"]


WRONG, RIGHT = (Batch,), (LooksOnceMore,)
