"""Nodes for the exercise `battery`, named by what is special or wrong about them."""

import itertools

import rclpy
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.node import Node


class Battery(Node):
    """Nothing is wrong with it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("battery")
        self.charge = 100
        self.create_timer(1.0, self.measure)
        self.show_debug_lines()

    def show_debug_lines(self):
        self.get_logger().set_level(LoggingSeverity.DEBUG)

    def measure(self):
        self.charge = max(0, self.charge - 10)
        self.debug()
        self.report(f"Battery: {self.charge} %")

    def debug(self):
        self.get_logger().debug("Measuring")

    def report(self, text):
        logger = self.get_logger()
        if self.charge > 30:
            logger.info(text)
        elif self.charge > 10:
            logger.warning(text)
        else:
            logger.error(text)


# Right


class FromEmptyToFull(Battery):
    def report(self, text):
        if self.charge <= 10:
            self.get_logger().error(text)
        elif self.charge <= 30:
            self.get_logger().warning(text)
        else:
            self.get_logger().info(text)


class LevelsInATable(Battery):
    def report(self, text):
        level = next(level for edge, level in ((10, 40), (30, 30), (100, 20)) if self.charge <= edge)
        {40: self.alarm, 30: self.warn, 20: self.inform}[level](text)

    def alarm(self, text):
        self.get_logger().error(text)

    def warn(self, text):
        self.get_logger().warning(text)

    def inform(self, text):
        self.get_logger().info(text)


def main_with_functions(args=None):
    rclpy.init(args=args)
    node, charges = rclpy.create_node("battery"), itertools.chain(range(90, 0, -10), itertools.repeat(0))
    logger = node.get_logger()
    set_logger_level("battery", LoggingSeverity.DEBUG)

    def measure():
        charge = next(charges)
        logger.debug("Measuring")
        if charge > 30:
            return logger.info(f"Battery: {charge} %")
        if charge > 10:
            return logger.warning(f"Battery: {charge} %")
        return logger.error(f"Battery: {charge} %")

    node.create_timer(1.0, measure)
    rclpy.spin(node)


# Wrong


class DebugHidden(Battery):
    def show_debug_lines(self):
        pass


class DebugAsInfo(Battery):
    def debug(self):
        self.get_logger().info("Measuring")


class DebugOnlyOnce(Battery):
    def show_debug_lines(self):
        super().show_debug_lines()
        self.get_logger().debug("Measuring")

    def debug(self):
        pass


class OnlyInfo(Battery):
    def report(self, text):
        self.get_logger().info(text)


class EdgesBelongAbove(Battery):
    def report(self, text):
        if self.charge >= 30:
            self.get_logger().info(text)
        elif self.charge >= 10:
            self.get_logger().warning(text)
        else:
            self.get_logger().error(text)


class IfInPlaceOfElif(Battery):
    def report(self, text):
        if self.charge > 30:
            self.get_logger().info(text)
        if self.charge > 10:
            self.get_logger().warning(text)
        else:
            self.get_logger().error(text)


class OneLineForTwoLevels(Battery):
    def report(self, text):
        log = self.get_logger().info if self.charge > 30 else self.get_logger().warning
        log(text)


class OneLineInALoop(Node):
    """Lesson 1's: one line of code logs at two levels."""

    def __init__(self):
        super().__init__("battery")
        for log in (self.get_logger().info, self.get_logger().warning):
            log("Battery: 90 %")


class SaysNothing(Battery):
    def report(self, text):
        pass


class Prints(Battery):
    def report(self, text):
        print(text)


class StopsAtTen(Battery):
    def report(self, text):
        if self.charge > 10:
            super().report(text)


class TwiceAsFast(Battery):
    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.measure)


class LevelAsText(Battery):
    def show_debug_lines(self):
        self.get_logger().set_level("debug")


class EveryTwoSeconds(Battery):
    """Its levels are right, as far as it comes."""

    def __init__(self):
        Node.__init__(self, "battery")
        self.charge = 100
        self.create_timer(2.0, self.measure)
        self.show_debug_lines()
