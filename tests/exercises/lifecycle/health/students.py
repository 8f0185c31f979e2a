"""Nodes that say how the robot is: right ones, and wrong ones named by their defect."""

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node
from sensor_msgs.msg import BatteryState, Temperature

OK, WARN, ERROR, STALE = (
    DiagnosticStatus.OK,
    DiagnosticStatus.WARN,
    DiagnosticStatus.ERROR,
    DiagnosticStatus.STALE,
)
PARTS = ("OK", "WARN", "ERROR", "STALE")


class Health(Node):
    """As one would write it; the wrong ones change one thing each."""

    names = ("battery", "motor")
    period = 1.0

    def __init__(self):
        super().__init__("health")
        self.numbers, self.received = {}, {}
        self.publisher = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self.create_subscription(BatteryState, "/battery_state", self.on_battery, 10)
        self.create_subscription(Temperature, "/motor_temperature", self.on_motor, 10)
        self.create_timer(self.period, self.report)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_battery(self, msg):
        self.keep("battery", 100 * msg.percentage)

    def on_motor(self, msg):
        self.keep("motor", msg.temperature)

    def keep(self, name, number):
        self.numbers[name], self.received[name] = number, self.now()

    def is_stale(self, name):
        return name not in self.received or self.now() - self.received[name] > 1.0

    def level(self, name):
        if self.is_stale(name):
            return STALE
        number = self.numbers[name]
        if name == "battery":
            return ERROR if number < 10 else WARN if number < 30 else OK
        return ERROR if number >= 80 else WARN if number >= 60 else OK

    def status(self, name):
        status = DiagnosticStatus(name=name, level=self.level(name))
        if name in self.numbers:
            key = "percent" if name == "battery" else "celsius"
            status.values = [KeyValue(key=key, value=self.text(self.numbers[name]))]
        return status

    def text(self, number):
        return f"{number:.1f}"

    def stamp(self, msg):
        msg.header.stamp = self.get_clock().now().to_msg()

    def report(self):
        msg = DiagnosticArray(status=[self.status(name) for name in self.names])
        self.stamp(msg)
        self.publisher.publish(msg)


class MotorFirst(Health):
    names = ("motor", "battery")


class InWholeNumbers(Health):
    """A design of its own: rounded, and with more to read."""

    def text(self, number):
        return str(round(number))

    def status(self, name):
        status = super().status(name)
        status.message, status.hardware_id = "see the values", "robot 1"
        return status


def main():
    rclpy.init()
    rclpy.spin(Health())


class AlwaysOk(Health):
    def level(self, name):
        return OK


class NeverStale(Health):
    """The last number is good forever."""

    def is_stale(self, name):
        return name not in self.received


class StaleTooSoon(Health):
    """0.15 s of silence, between two messages, are enough for it."""

    def is_stale(self, name):
        return name not in self.received or self.now() - self.received[name] > 1e-3


class BetterOneFirst(Health):
    """Below 30 % is asked for first, so it is never an error."""

    def level(self, name):
        return min(super().level(name), WARN) if not self.is_stale(name) else STALE


class FractionForPercent(Health):
    """0.5 is below 30."""

    def on_battery(self, msg):
        self.keep("battery", msg.percentage)


class ValueAsAFraction(Health):
    def status(self, name):
        status = super().status(name)
        if name == "battery" and status.values:
            status.values[0].value = str(self.numbers[name] / 100)
        return status


class ValueWithAUnit(Health):
    def text(self, number):
        return f"{number:.1f} units"


class NoValues(Health):
    def status(self, name):
        return DiagnosticStatus(name=name, level=self.level(name))


class NoStamp(Health):
    def stamp(self, msg):
        pass


class LevelAsANumber(Health):
    """A level is a byte."""

    def level(self, name):
        return int.from_bytes(super().level(name), "little")


class OneForEach(Health):
    """An array for each of the two."""

    def report(self):
        for name in self.names:
            msg = DiagnosticArray(status=[self.status(name)])
            self.stamp(msg)
            self.publisher.publish(msg)


class WithoutNames(Health):
    def status(self, name):
        status = super().status(name)
        status.name = ""
        return status


class WithEachMessage(Health):
    """Reports whenever something comes: far too often, and never of silence."""

    period = 1000.0

    def keep(self, name, number):
        super().keep(name, number)
        self.report()


class ZeroIsNoNews(Health):
    """An empty battery has a number, too."""

    def is_stale(self, name):
        return not self.numbers.get(name) or super().is_stale(name)


class RoundsFirst(Health):
    """59.9 degrees are not 60 yet."""

    def keep(self, name, number):
        super().keep(name, round(number))


class StampOfTheBeginning(Health):
    def stamp(self, msg):
        self.first = getattr(self, "first", None) or self.get_clock().now().to_msg()
        msg.header.stamp = self.first
