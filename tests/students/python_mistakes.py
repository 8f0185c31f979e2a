"""Nodes with one mistake each of Python's own kind, named by it: files, unreadable code, shapes, inf."""

import asyncio
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class Worker(Node):
    """Does its work after a second; nothing is wrong with it."""

    def __init__(self):
        super().__init__("worker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.work(np.zeros((2, 3)))

    def work(self, table):
        return table @ np.zeros(3)


class AddsOtherShapes(Worker):
    def work(self, table):
        return table[0] + np.zeros(2)


class FillsTooSmallAPlace(Worker):
    def work(self, table):
        table[0, :2] = np.zeros(3)


class MultipliesOtherShapes(Worker):
    def work(self, table):
        return table @ np.zeros(2)


class DotsOtherShapes(Worker):
    def work(self, table):
        return np.dot(table, np.zeros(2))


class ChoosesByAnotherLength(Worker):
    def work(self, table):
        return table[np.zeros(4, bool)]


class AsksAnArray(Worker):
    def work(self, table):
        return 1 if table > 0 else 0


class Imports(Worker):
    """Writes a module and imports it."""

    module, code = "right_module", "def double(x):\n    return 2 * x\n"

    def work(self, table):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, f"{self.module}.py").write_text(self.code, encoding="utf-8")
            sys.path.insert(0, folder)
            try:
                __import__(self.module)
            finally:
                sys.path.remove(folder)


class ForgetsToIndent(Imports):
    module, code = "not_indented", "def double(x):\nreturn 2 * x\n"


class IndentsTooFar(Imports):
    module, code = "too_far", "x = 1\n    y = 2\n"


class MixesTabs(Imports):
    module, code = "mixed_tabs", "def double(x):\n\ty = 2 * x\n        return y\n"


class ForgetsTheColon(Imports):
    module, code = "no_colon", "def double(x)\n    return 2 * x\n"


class ForgetsABracket(Imports):
    module, code = "open_bracket", "x = 1\ny = (2, 3\n"


class WritesNonsense(Imports):
    module, code = "nonsense", "x = = 1\n"


class SleepsWithAsyncio(Worker):
    async def tick(self):
        await asyncio.sleep(0.1)


class RunsAsyncio(Worker):
    def tick(self):
        asyncio.run(asyncio.sleep(0.1))


async def spinning(node_class):
    """Let asyncio drive rclpy."""
    rclpy.init()
    node = node_class()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.0)
        await asyncio.sleep(0.02)


def awaits_in_asyncios_loop():
    """asyncio drives rclpy, and a callback of rclpy awaits what is asyncio's."""
    asyncio.run(spinning(SleepsWithAsyncio))


def runs_in_asyncios_loop():
    """asyncio drives rclpy, and a callback of rclpy starts asyncio once more."""
    asyncio.run(spinning(RunsAsyncio))


class OpensNoFile(Worker):
    def work(self, table):
        return Path("map.yaml").read_text(encoding="utf-8")


class StartsNoProgram(Worker):
    def work(self, table):
        subprocess.run(["ros2", "topic", "list"], check=True, env={"PATH": "/nowhere"})


class MakesAnIntOfInf(Worker):
    def work(self, table):
        return int(math.inf)


class MakesAnIntOfNan(Worker):
    def work(self, table):
        return int(math.nan)


class Scanner(Node):
    """Publishes a scan every half second; nothing is wrong with it."""

    def __init__(self):
        super().__init__("scanner")
        self.publisher = self.create_publisher(LaserScan, "scan", 10)
        self.create_timer(0.5, self.scan)

    def scan(self):
        self.publisher.publish(LaserScan(ranges=[1.0, math.inf, 2.0, -math.inf, math.inf, math.nan]))


class MapsEveryRay(Node):
    """Makes a cell's number of each ray of /scan."""

    def __init__(self):
        super().__init__("mapper")
        self.create_subscription(LaserScan, "scan", self.draw, 10)

    def draw(self, scan):
        return [math.floor(distance / 0.1) for distance in scan.ranges]
