"""Programs that use what else rclpy has: contexts, events of endpoints, descriptors, clocks, bags."""

import argparse
import contextlib
import tempfile
import threading

import rclpy
import rosbag2_py
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.clock import Clock, ClockType, JumpThreshold
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter_event_handler import ParameterEventHandler
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.serialization import serialize_message
from rclpy.utilities import remove_ros_args
from std_msgs.msg import Float64, String


class WatchesItsEndpoints(Node):
    """Logs each match, and would log a deadline that is missed."""

    def __init__(self):
        super().__init__("endpoints")
        qos = QoSProfile(depth=5, deadline=Duration(seconds=0.5))
        seen = self.get_logger().info
        publisher_events = PublisherEventCallbacks(
            deadline=lambda event: seen("late"), matched=lambda event: seen(f"{event.current_count} listen")
        )
        self.outlet = self.create_publisher(String, "beat", qos, event_callbacks=publisher_events)
        events = SubscriptionEventCallbacks(matched=lambda event: seen(f"{event.current_count} talk"))
        self.create_subscription(String, "beat", lambda message: None, qos, event_callbacks=events)
        self.create_timer(0.2, lambda: self.outlet.publish(String()))


class StartsItsTimerLater(Node):
    """The second timer is created at rest; the first one starts it, and then ends."""

    def __init__(self):
        super().__init__("later")
        self.outlet = self.create_publisher(String, "chatter", 10)
        self.work = self.create_timer(0.2, self.tick, autostart=False)
        self.start = self.create_timer(1.0, self.begin)

    def begin(self):
        self.start.cancel()
        self.work.reset()

    def tick(self):
        self.outlet.publish(String(data="at work"))


class LogsNowAndThen(Node):
    """Lines with a throttle, once, and of a child logger; nothing else."""

    def __init__(self):
        super().__init__("logs", enable_logger_service=True)
        self.part = self.get_logger().get_child("part")
        self.create_timer(0.05, self.tick)

    def tick(self):
        self.get_logger().info("alive", throttle_duration_sec=1.0)
        self.get_logger().warning("said once", once=True)
        self.part.debug("seldom", skip_first=True)


class AllParametersAtOnce(Node):
    """Takes whatever it is given, with a prefix, a range, and a value that another one sets."""

    def __init__(self):
        super().__init__("all", automatically_declare_parameters_from_overrides=True)
        limits = FloatingPointRange(from_value=0.0, to_value=2.0, step=0.0)
        self.declare_parameters(
            "gains", [("p", 1.0, ParameterDescriptor(floating_point_range=[limits])), ("d", 0.1)]
        )
        self.add_pre_set_parameters_callback(lambda parameters: parameters)
        self.add_post_set_parameters_callback(self.changed)
        self.handler = ParameterEventHandler(self)
        self.handler.add_parameter_callback("gains.p", "all", lambda parameter: None)
        self.create_timer(1.0, self.tune)

    def tune(self):
        self.set_parameters_atomically([rclpy.parameter.Parameter("gains.p", value=1.5)])

    def changed(self, parameters):
        gains = self.get_parameters_by_prefix("gains")
        self.get_logger().info(f"p is {gains['p'].value}")


class QosByParameters(Node):
    """Who starts it may change the QoS."""

    def __init__(self):
        super().__init__("tunable_qos")
        options = QoSOverridingOptions.with_default_policies()
        self.outlet = self.create_publisher(String, "chatter", 10, qos_overriding_options=options)
        self.create_timer(0.5, lambda: self.outlet.publish(String(data="hello")))


class ManyClocks(Node):
    """Looks at each clock there is, and would notice a jump."""

    def __init__(self):
        super().__init__("clocks")
        clocks = [Clock(clock_type=kind) for kind in (ClockType.SYSTEM_TIME, ClockType.STEADY_TIME)]
        threshold = JumpThreshold(min_forward=Duration(seconds=1), min_backward=Duration(seconds=-1))
        self.jump = self.get_clock().create_jump_callback(threshold, post_callback=self.on_jump)
        self.outlet = self.create_publisher(Float64, "drift", 10)
        self.begin = [clock.now() for clock in clocks]
        self.create_timer(0.5, lambda: self.tick(clocks))

    def on_jump(self, jump):
        self.get_logger().warning(f"{jump.delta}")

    def tick(self, clocks):
        system, steady = (clock.now() - begin for clock, begin in zip(clocks, self.begin, strict=True))
        self.outlet.publish(Float64(data=(system.nanoseconds - steady.nanoseconds) / 1e9))


def with_its_own_context():
    """Its context, executor and thread are its own; the main thread waits for an event."""
    with contextlib.suppress(KeyboardInterrupt), Context() as context:
        node = Node("own_context", context=context)
        outlet = node.create_publisher(String, "chatter", 10)
        node.create_timer(0.5, lambda: outlet.publish(String(data="apart")))
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        threading.Thread(target=executor.spin, daemon=True).start()
        threading.Event().wait()


def reads_its_command_line(args=None):
    """Options of its own beside those of ROS."""
    rclpy.init(args=args)
    parser = argparse.ArgumentParser()
    parser.add_argument("--word", default="hello")
    options = parser.parse_args(remove_ros_args(args)[1:])
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        node = rclpy.create_node("options")
        outlet = node.create_publisher(String, "chatter", 10)
        node.create_timer(0.5, lambda: outlet.publish(String(data=options.word)))
        rclpy.spin(node)
    rclpy.try_shutdown()


class Records(Node):
    """Writes what it receives, and what it sends, into a bag."""

    def __init__(self):
        super().__init__("records")
        self.folder = tempfile.TemporaryDirectory()
        self.writer = rosbag2_py.SequentialWriter()
        options = rosbag2_py.StorageOptions(uri=f"{self.folder.name}/bag", storage_id="mcap")
        self.writer.open(options, rosbag2_py.ConverterOptions("", ""))
        topic = rosbag2_py.TopicMetadata(
            id=0, name="chatter", type="std_msgs/msg/String", serialization_format="cdr"
        )
        self.writer.create_topic(topic)
        self.create_subscription(String, "chatter", self.receive, 10)
        self.outlet = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.5, lambda: self.outlet.publish(String(data="kept")))

    def receive(self, message):
        stamp = self.get_clock().now().nanoseconds
        self.writer.write("chatter", serialize_message(message), stamp)

    def destroy_node(self):
        self.writer.close()
        self.folder.cleanup()
        super().destroy_node()


CORPUS = [
    (WatchesItsEndpoints,),
    (StartsItsTimerLater,),
    (LogsNowAndThen,),
    (AllParametersAtOnce,),
    (QosByParameters,),
    (ManyClocks,),
    (with_its_own_context,),
    (reads_its_command_line,),
    (Records,),
]
