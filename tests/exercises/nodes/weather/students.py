"""Nodes for the exercise `weather`, named by what is special or wrong about them."""

import itertools
import time

import rclpy
from rclpy.node import Node

PARTS = ("to_fahrenheit", "describe")
READINGS = (-8, -1, 0, 12, 29, 30, 35)


def to_fahrenheit(celsius):
    return celsius * 9 / 5 + 32


def describe(celsius):
    return "frost" if celsius < 0 else "mild" if celsius < 30 else "hot"


class Weather(Node):
    """Nothing is wrong with it; the wrong ones change one thing each."""

    to_fahrenheit, describe = staticmethod(to_fahrenheit), staticmethod(describe)
    period = 1.0

    def __init__(self):
        super().__init__("weather")
        self.next = 0
        self.create_timer(self.period, self.report)

    def reading(self):
        reading = READINGS[self.next % len(READINGS)]
        self.next += 1
        return reading

    def report(self):
        celsius = self.reading()
        word = self.describe(celsius)
        self.log(f"{celsius} C = {self.to_fahrenheit(celsius):.1f} F, {word}", word)

    def log(self, text, word):
        if word == "mild":
            self.get_logger().info(text)
        else:
            self.get_logger().warning(text)


# Right


class CyclesThroughReadings(Weather):
    def __init__(self):
        super().__init__()
        self.readings = itertools.cycle(READINGS)

    def reading(self):
        return float(next(self.readings))


class WithDegreeSigns(Weather):
    def report(self):
        celsius = self.reading()
        word = self.describe(celsius)
        self.log(f"{celsius} °C = {round(self.to_fahrenheit(celsius), 1)} °F: {word}", word)


# Wrong


class WithoutAName(Weather):
    def __init__(self):
        Node.__init__(self, "my_node")
        self.next = 0
        self.create_timer(1.0, self.report)


class AddsBeforeItMultiplies(Weather):
    def to_fahrenheit(self, celsius):
        return (celsius + 32) * 9 / 5


class WholeDegreesOnly(Weather):
    def to_fahrenheit(self, celsius):
        return celsius * 9 // 5 + 32


class NothingReturned(Weather):
    def to_fahrenheit(self, celsius):
        celsius * 9 / 5 + 32


class ZeroIsFrost(Weather):
    def describe(self, celsius):
        return "frost" if celsius <= 0 else "mild" if celsius < 30 else "hot"


class EverythingIsInformation(Weather):
    def log(self, text, word):
        self.get_logger().info(text)


class AlwaysTheFirst(Weather):
    def reading(self):
        return READINGS[0]


class RunsOut(Weather):
    def reading(self):
        self.next += 1
        return READINGS[self.next - 1]


class AllInOneCallback(Weather):
    def report(self):
        for _ in READINGS:
            super().report()


class TwiceAsFast(Weather):
    period = 0.5


class WordAlone(Weather):
    def log(self, text, word):
        self.get_logger().info(word)


def main_with_a_loop(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("weather")
    for celsius in itertools.cycle(READINGS):
        word = describe(celsius)
        text = f"{celsius} C = {to_fahrenheit(celsius)} F, {word}"
        if word == "mild":
            node.get_logger().info(text)
        else:
            node.get_logger().warn(text)
        time.sleep(1.0)
