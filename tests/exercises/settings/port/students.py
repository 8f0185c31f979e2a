"""Thermometers, ported from ROS 1: right ones, and wrong ones named by their defect."""

import threading
import time

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Temperature
from std_msgs.msg import Float64

PARTS = ("WithoutATimer", "LoopInAGroup")


class Thermometer(Node):
    """As one would write it; the others change one thing each."""

    name, topic, type = "thermometer", "/engine/temperature", Temperature
    parameter, default, period = "gain", 25.0, 0.2

    def __init__(self):
        super().__init__(self.name)
        self.volts = None
        self.declare()
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_subscription(Float64, "/engine/volts", self.receive, 10)
        self.start()

    def declare(self):
        self.declare_parameter(self.parameter, self.default)

    def start(self):
        self.create_timer(self.period, self.work)

    def receive(self, msg):
        self.volts = msg.data

    def work(self):
        if self.volts is not None:
            self.publish(self.gain() * self.volts)

    def gain(self):
        return self.get_parameter(self.parameter).value

    def publish(self, temperature):
        msg = self.type()
        msg.header.stamp = self.stamp()
        msg.header.frame_id = "engine"
        msg.temperature = temperature
        self.publisher.publish(msg)
        self.report(temperature)

    def stamp(self):
        return self.get_clock().now().to_msg()

    def report(self, temperature):
        if temperature > 80.0:
            self.get_logger().warning(f"engine at {temperature:.1f} degrees")


class NewestGain(Thermometer):
    """Keeps the gain in a field, which changes whenever the parameter is set; and warns first."""

    def declare(self):
        self.value = self.declare_parameter("gain", 25.0).value
        self.add_post_set_parameters_callback(self.on_set)

    def on_set(self, parameters):
        self.value = {parameter.name: parameter.value for parameter in parameters}.get("gain", self.value)

    def gain(self):
        return self.value

    def publish(self, temperature):
        self.report(temperature)
        header = Temperature().header
        header.frame_id, header.stamp = "engine", self.stamp()
        self.publisher.publish(Temperature(header=header, temperature=temperature))

    def report(self, temperature):
        if temperature > 80.0:
            self.get_logger().warn("too hot")


class WithoutATimer(Thermometer):
    """The loop of the listing stays, in main; another thread spins."""

    def start(self):
        pass


def loop_beside_a_spinning_thread():
    rclpy.init()
    node = WithoutATimer()
    thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    thread.start()
    rate = node.create_rate(5)
    try:
        while rclpy.ok():
            node.work()
            rate.sleep()
    except ExternalShutdownException:
        pass


def loop_that_spins_in_between():
    """The loop of the listing, and in it spin_once until the next moment."""
    rclpy.init()
    node = WithoutATimer()
    clock = node.get_clock()
    following = clock.now().nanoseconds
    while rclpy.ok():
        node.work()
        following += 200_000_000
        while rclpy.ok() and (left := following - clock.now().nanoseconds) > 0:
            rclpy.spin_once(node, timeout_sec=left / 1e9)


class LoopInAGroup(Thermometer):
    """The loop is a callback that never ends."""

    def start(self):
        self.once = self.create_timer(0.01, self.loop, callback_group=MutuallyExclusiveCallbackGroup())

    def loop(self):
        self.once.cancel()
        while rclpy.ok():
            self.work()
            time.sleep(0.2)


def loop_in_a_group():
    """A design of its own: the loop is a callback that never ends, and threads run the others."""
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(LoopInAGroup())
    executor.spin()


class LoopInTheConstructor(Thermometer):
    """Lesson 3's: the constructor never returns, and the node never spins."""

    def __init__(self):
        super().__init__()
        while rclpy.ok():
            self.work()
            time.sleep(0.2)


class LoopInACallback(Thermometer):
    """It begins with the first volts, and no other volts ever get through."""

    def start(self):
        pass

    def receive(self, msg):
        super().receive(msg)
        while rclpy.ok():
            self.work()
            time.sleep(0.2)


class RateInACallback(Thermometer):
    """The rate's own timer waits for the executor, which waits for this callback."""

    def start(self):
        self.rate = self.create_rate(5)

    def receive(self, msg):
        super().receive(msg)
        while rclpy.ok():
            self.work()
            self.rate.sleep()


class PublishesInReceive(Thermometer):
    """Volts in, temperature out: as often as volts arrive."""

    def start(self):
        pass

    def receive(self, msg):
        super().receive(msg)
        self.work()


class PeriodOfFive(Thermometer):
    """Five seconds in place of five times a second."""

    period = 5.0


class NothingBeforeTheVolts(Thermometer):
    """0.0 is a temperature, too."""

    def work(self):
        self.volts = self.volts or 0.0
        super().work()


class FirstVolts(Thermometer):
    def receive(self, msg):
        if self.volts is None:
            super().receive(msg)


class ForgetsTheGain(Thermometer):
    def gain(self):
        return 1.0


class IntegerGain(Thermometer):
    """As in the listing: but in ROS 2 the default decides the kind."""

    default = 25


class GainOnce(Thermometer):
    def declare(self):
        super().declare()
        self.value = self.get_parameter("gain").value

    def gain(self):
        return self.value


class RefusesOthers(Thermometer):
    """A gain is the engine's: it can be given at the start, and never changes."""

    def declare(self):
        self.declare_parameter("gain", 25.0, ParameterDescriptor(read_only=True))


class FixedGain(Thermometer):
    def declare(self):
        pass

    def gain(self):
        return 25.0


class StampOfTheStart(Thermometer):
    def declare(self):
        super().declare()
        self.begin = self.get_clock().now().to_msg()

    def stamp(self):
        return self.begin


class NoStamp(Thermometer):
    def stamp(self):
        return Temperature().header.stamp


class NoFrame(Thermometer):
    def publish(self, temperature):
        msg = Temperature(temperature=temperature)
        msg.header.stamp = self.stamp()
        self.publisher.publish(msg)
        self.report(temperature)


class OtherFrame(Thermometer):
    def publish(self, temperature):
        msg = Temperature(temperature=temperature)
        msg.header.stamp, msg.header.frame_id = self.stamp(), "/engine"
        self.publisher.publish(msg)
        self.report(temperature)


class InfoInPlaceOfAWarning(Thermometer):
    def report(self, temperature):
        if temperature > 80.0:
            self.get_logger().info(f"engine at {temperature:.1f} degrees")


class WarnsAlways(Thermometer):
    def report(self, temperature):
        self.get_logger().warning(f"engine at {temperature:.1f} degrees")


class OtherName(Thermometer):
    name = "meter"


class OnlyANumber(Thermometer):
    type = Float64

    def publish(self, temperature):
        self.publisher.publish(Float64(data=temperature))
