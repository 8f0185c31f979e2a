"""A thread destroys what a callback is using (as in rosbridge#1194 and innate-os#497)."""

import threading
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Switches(Node):
    """A timer publishes on a topic that a thread changes now and then."""

    def __init__(self):
        super().__init__("switches")
        self.publisher = self.create_publisher(String, "topic_0", 10)
        self.create_timer(0.01, self.send)
        threading.Thread(target=self.work, daemon=True).start()

    def work(self):
        for number in range(1, 6):
            time.sleep(0.1)
            self.switch(f"topic_{number}")

    def switch(self, topic):
        self.destroy_publisher(self.publisher)
        self.publisher = self.create_publisher(String, topic, 10)

    def send(self):
        self.publisher.publish(String(data="on"))


class HandsOver(Switches):
    """Lets the executor change the topic: its callbacks don't run at the same time."""

    def switch(self, topic):
        if rclpy.ok():
            self.executor.create_task(super().switch, topic)


WRONG, RIGHT = (Switches,), (HandsOver,)
