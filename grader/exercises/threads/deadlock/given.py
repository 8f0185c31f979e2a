"""The program that hangs, and its thread dump.

The dump is what faulthandler printed, from this program on stock rclpy, after one message on each topic: on
/sweep a moment after the others. Only paths are shortened, and frames of Python and rclpy left out.
"""

DEPOT = '''\
"""A depot with a corridor and a lift. Its jobs wait for each other, and after 3 s it prints where."""

import faulthandler
import threading
import time

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32, String


class Depot(Node):
    def __init__(self):
        super().__init__("depot")
        self.corridor, self.lift = threading.Lock(), threading.Lock()
        self.places = self.create_publisher(String, "/places", 10)
        self.done = self.create_publisher(String, "/done", 10)
        self.listen("/up", self.up)
        self.listen("/down", self.down)
        self.listen("/sweep", self.sweep)
        group = self.listen("/load", self.load)
        self.scale = self.create_client(AddTwoInts, "/scale", callback_group=group)

    def listen(self, topic, callback):
        group = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Int32, topic, callback, 10, callback_group=group)
        return group

    def drive(self, job, places):
        self.places.publish(String(data=f"{job} enters {places}"))
        time.sleep(0.15)
        self.places.publish(String(data=f"{job} leaves {places}"))

    def up(self, msg):
        with self.corridor:
            self.drive("up", "corridor")
            with self.lift:
                self.drive("up", "corridor lift")
        self.done.publish(String(data=f"up {msg.data}"))

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            with self.corridor:
                self.drive("down", "corridor lift")
        self.done.publish(String(data=f"down {msg.data}"))

    def sweep(self, msg):
        with self.corridor:
            self.drive("sweep", "corridor")
            self.drive("sweep", "corridor")
        self.done.publish(String(data=f"sweep {msg.data}"))

    def load(self, msg):
        weight = self.scale.call(AddTwoInts.Request(a=msg.data)).sum
        with self.lift:
            self.drive("load", "lift")
        self.done.publish(String(data=f"load {msg.data} {weight}"))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=5)
    executor.add_node(Depot())
    executor.spin()


if __name__ == "__main__":
    faulthandler.dump_traceback_later(3.0, exit=True)
    main()
'''

DUMP = '''\
Timeout (0:00:03)!
Thread 0x00007f4ba77fe6c0 (most recent call first):
  File "depot.py", line 52 in sweep
  File ".../rclpy/executors.py", line 111 in await_or_execute
  ...

Thread 0x00007f4ba7fff6c0 (most recent call first):
  File ".../threading.py", line 327 in wait
  File ".../threading.py", line 629 in wait
  File ".../rclpy/client.py", line 105 in call
  File "depot.py", line 58 in load
  File ".../rclpy/executors.py", line 111 in await_or_execute
  ...

Thread 0x00007f4bb4dfd6c0 (most recent call first):
  File "depot.py", line 47 in down
  File ".../rclpy/executors.py", line 111 in await_or_execute
  ...

Thread 0x00007f4bb55fe6c0 (most recent call first):
  File "depot.py", line 40 in up
  File ".../rclpy/executors.py", line 111 in await_or_execute
  ...

Thread 0x00007f4be59c1500 (most recent call first):
  File ".../rclpy/executors.py", line 697 in _wait_for_ready_callbacks
  ...
  File "depot.py", line 68 in main
  File "depot.py", line 73 in <module>
'''
