"""Meters of a stream: right ones, and wrong ones named by their defect."""

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Float64, Header, Int32


class Meter(Node):
    """As one would write it; the wrong ones change one thing each."""

    period, allowed = 0.02, 0.01  # s

    def __init__(self):
        super().__init__("meter")
        self.before, self.late = None, 0
        self.outlets = {
            name: self.create_publisher(kind, name, 10)
            for name, kind in (("/latency", Float64), ("/jitter", Float64), ("/late", Int32))
        }
        self.create_subscription(Header, "/beat", self.on_message, 10)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_message(self, msg):
        now, measured = self.now(), Time.from_msg(msg.stamp).nanoseconds / 1e9
        self.say("/latency", self.latency(now, measured))
        if self.before is not None:
            self.say("/jitter", self.jitter(now - self.before))
        self.before = self.moment(now, measured)
        self.count(now - measured)
        self.say("/late", self.late)

    def say(self, topic, value):
        self.outlets[topic].publish(Int32(data=value) if topic == "/late" else Float64(data=value))

    def latency(self, now, measured):
        return now - measured

    def moment(self, now, measured):
        return now

    def jitter(self, gap):
        return abs(gap - self.period)

    def count(self, latency):
        if latency > self.allowed:
            self.late += 1


class Durations(Node):
    """A design of its own: with ROS's own times."""

    def __init__(self):
        super().__init__("meter")
        self.last, self.misses = None, 0
        self.latency = self.create_publisher(Float64, "latency", 10)
        self.jitter = self.create_publisher(Float64, "jitter", 10)
        self.late = self.create_publisher(Int32, "late", 10)
        self.create_subscription(Header, "beat", self.on_beat, 10)

    def on_beat(self, header):
        arrived = self.get_clock().now()
        latency = (arrived - Time.from_msg(header.stamp)).nanoseconds
        self.latency.publish(Float64(data=latency * 1e-9))
        self.misses += latency > 10_000_000
        self.late.publish(Int32(data=self.misses))
        if self.last:
            self.jitter.publish(Float64(data=abs((arrived - self.last).nanoseconds - 20_000_000) * 1e-9))
        self.last = arrived


def main_without_a_class():
    rclpy.init()
    node = rclpy.create_node("meter")
    latency = node.create_publisher(Float64, "/latency", 10)
    jitter = node.create_publisher(Float64, "/jitter", 10)
    late = node.create_publisher(Int32, "/late", 10)
    arrivals, waits = [], []

    def on_message(msg):
        arrivals.append(node.get_clock().now().nanoseconds / 1e9)
        waits.append(arrivals[-1] - msg.stamp.sec - msg.stamp.nanosec / 1e9)
        latency.publish(Float64(data=waits[-1]))
        late.publish(Int32(data=sum(wait > 0.01 for wait in waits)))
        if len(arrivals) > 1:
            jitter.publish(Float64(data=abs(arrivals[-1] - arrivals[-2] - 0.02)))

    node.create_subscription(Header, "/beat", on_message, 10)
    rclpy.spin(node)


class OtherTopic(Meter):
    def __init__(self):
        Node.__init__(self, "meter")
        self.create_subscription(Header, "/tick", self.on_message, 10)


class SignTurned(Meter):
    def latency(self, now, measured):
        return measured - now


class TimeOfDay(Meter):
    def latency(self, now, measured):
        return now


class NoLatency(Meter):
    """Publishes none."""

    def say(self, topic, value):
        if topic != "/latency":
            super().say(topic, value)


class AllInTheEnd(Meter):
    """Right numbers, when no one needs them any more."""

    def __init__(self):
        super().__init__()
        self.kept = []
        self.create_timer(4.9, self.tell)

    def say(self, topic, value):
        self.kept.append((topic, value))

    def tell(self):
        self.say = super().say
        for topic, value in self.kept:
            self.say(topic, value)


class ByTheStamps(Meter):
    """From one stamp to the next, not from arrival to arrival."""

    def on_message(self, msg):
        self.stamp = Time.from_msg(msg.stamp).nanoseconds / 1e9
        super().on_message(msg)

    def moment(self, now, measured):
        self.old = measured
        return now

    def jitter(self, gap):
        return abs(self.stamp - self.old - self.period)


class WithSign(Meter):
    def jitter(self, gap):
        return gap - self.period


class WholeGap(Meter):
    def jitter(self, gap):
        return gap


class OtherPeriod(Meter):
    period = 0.05


class OneByOne(Meter):
    def count(self, latency):
        self.late = int(latency > self.allowed)


class CountsThoseInTime(Meter):
    def count(self, latency):
        self.late += latency <= self.allowed


class TooStrict(Meter):
    allowed = 0.005


class SpeaksOnlyWhenLate(Meter):
    def say(self, topic, value):
        if self.late or topic != "/late":
            super().say(topic, value)


class Milliseconds(Meter):
    def latency(self, now, measured):
        return (now - measured) * 1000


class LatencyOnly(Meter):
    """Has one publisher, and uses it."""

    def __init__(self):
        Node.__init__(self, "meter")
        self.before, self.late = None, 0
        self.publisher = self.create_publisher(Float64, "/latency", 10)
        self.create_subscription(Header, "/beat", self.on_message, 10)

    def say(self, topic, value):
        if topic == "/latency":
            self.publisher.publish(Float64(data=value))
