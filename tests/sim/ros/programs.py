"""Scenarios for comparing runs of different processes; as a program, it prints one digest each."""

from __future__ import annotations

import random
import sys

from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

from sim import Recording, run
from tests.sim.ros import all_worlds
from tests.students.engine import actions, callers, goals, mains, services, threads, timing
from tests.students.machines import arm, cart_pole


class Wanderer(Node):
    """Drives where there is room; uses chance, sets and a service on the way."""

    def __init__(self):
        super().__init__("wanderer")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(LaserScan, "scan", self.look, 10)
        self.client = self.create_client(AddTwoInts, "add")
        self.create_timer(0.1, self.drive)
        self.free = 0.0

    def look(self, scan):
        self.free = min(min(scan.ranges[:20]), min(scan.ranges[-20:]))

    def drive(self):
        command = Twist()
        command.linear.x = 0.4 if self.free > 0.5 else 0.0
        command.angular.z = random.uniform(-0.5, 0.5) if self.free > 0.5 else 1.0
        self.publisher.publish(command)
        self.client.call_async(AddTwoInts.Request(a=round(self.free * 1000), b=1))
        self.get_logger().info(" ".join({"set", "order", "is", "no", "evidence"} & {"set"}))


def scenarios() -> list[Recording]:
    """A robot with chance and services; threads, locks, actions, clocks; calls and goals; every world.

    And machines under control: one along a trajectory, one in a loop of 100 Hz.
    """
    return [
        run(Wanderer, services.Adder, world="room", seconds=10, seed=3, quiet=True),
        run(threads.lock_across_sleeps, threads.queues, mains.classic, seconds=10, quiet=True),
        run(actions.parallel_server, actions.Impatient, timing.all_clocks, seconds=5, quiet=True),
        run(services.SlowAdder, callers.First, callers.Second, callers.Flood, seconds=9, quiet=True),
        run(goals.two_servers, actions.Client, goals.SameIdTwice, seconds=5, quiet=True),
        run(arm.Reporter, world="arm", seconds=3, quiet=True),
        run(cart_pole.Balancer, world="cart_pole", seconds=5, seed=3, quiet=True),
        *(all_worlds.in_use(world, seconds=6) for world in all_worlds.worlds().values()),
    ]


if __name__ == "__main__":
    sys.stdout.write(" ".join(recording.digest for recording in scenarios()) + "\n")
