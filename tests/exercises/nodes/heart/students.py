"""Nodes for the exercise `heart`, named by what is special or wrong about them."""

import itertools
import time

import rclpy
from rclpy.node import Node


class Heart(Node):
    """Nothing is wrong with it; the wrong ones change one thing each."""

    namespace, beat_period, report_period = "/robot1", 0.25, 1.0

    def __init__(self):
        super().__init__("heart", namespace=self.namespace)
        self.beats = 0
        self.create_timer(self.beat_period, self.beat)
        self.create_timer(self.report_period, self.report)

    def beat(self):
        self.beats += 1
        self.get_logger().info("Beat")

    def report(self):
        self.get_logger().info(f"Beats: {self.beats}")


# Right


class ReportsFirst(Heart):
    namespace = "robot1"

    def __init__(self):
        Node.__init__(self, "heart", namespace=self.namespace)
        self.beats = 0
        self.create_timer(1.0, self.report)
        self.create_timer(0.25, self.beat)


def main_with_one_timer(args=None):
    rclpy.init(args=args)
    node, beats = rclpy.create_node("heart", namespace="/robot1"), []

    def beat():
        beats.append("Beat")
        node.get_logger().info("Beat")
        if len(beats) % 4 == 0:
            node.get_logger().info(f"Beats: {len(beats)}")

    node.create_timer(0.25, beat)
    rclpy.spin(node)


def main_with_arguments(args=None):
    class Plain(Heart):
        def __init__(self):
            Node.__init__(self, "heart")
            self.beats = 0
            self.create_timer(0.25, self.beat)
            self.create_timer(1.0, self.report)

    rclpy.init(args=["--ros-args", "-r", "__ns:=/robot1"])
    rclpy.spin(Plain())


# Wrong


class WithoutNamespace(Heart):
    namespace = ""


class NamespaceInTheName(Heart):
    def __init__(self):
        Node.__init__(self, "robot1_heart")
        self.beats = 0
        self.create_timer(0.25, self.beat)
        self.create_timer(1.0, self.report)


class SlashInTheName(Heart):
    def __init__(self):
        Node.__init__(self, "robot1/heart")


class PeriodsSwapped(Heart):
    beat_period, report_period = 1.0, 0.25


class FourInPlaceOfAQuarter(Heart):
    beat_period = 4.0


class ReportsBySleeping(Heart):
    def report(self):
        time.sleep(1.0)
        super().report()


class ResetsTheCount(Heart):
    def report(self):
        super().report()
        self.beats = 0


class OneTimer(Heart):
    def __init__(self):
        Node.__init__(self, "heart", namespace="/robot1")
        self.beats = 0
        self.create_timer(0.25, self.beat)


class ReportWithoutNumber(Heart):
    def report(self):
        self.get_logger().info("Beats: {self.beats}")


class LoopsInInit(Node):
    """Never comes out of its __init__: no one can spin it."""

    def __init__(self):
        super().__init__("heart", namespace="/robot1")
        for beat in itertools.count(1):
            time.sleep(0.25)
            self.get_logger().info("Beat")
            if beat % 4 == 0:
                self.get_logger().info(f"Beats: {beat}")
