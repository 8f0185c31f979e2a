"""Reports of a bag: right ones, and wrong ones named after their defect."""

import bisect
import itertools
import statistics
from collections import Counter
from dataclasses import dataclass

import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformListener

PARTS = "_Scan", "_summary"
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Report(Node):
    """As one would write it; the wrong ones change one thing each."""

    scan_qos = qos_profile_sensor_data

    def __init__(self):
        super().__init__("bag_report")
        self.stamps, self.arrivals, self.statics = [], [], 0
        self.publisher = self.create_publisher(DiagnosticStatus, "/bag_report", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, self.scan_qos)
        self.create_subscription(TFMessage, "/tf_static", self.on_static, LATCHED)
        self.create_timer(1.0, self.report)

    def on_scan(self, scan):
        self.stamps.append(Time.from_msg(scan.header.stamp).nanoseconds / 1e9)
        self.arrivals.append(self.get_clock().now().nanoseconds / 1e9)

    def on_static(self, msg):
        self.statics += len(msg.transforms)

    def times(self):
        return self.stamps

    def steps(self):
        return [after - before for before, after in itertools.pairwise(self.times())]

    def rate(self):
        return 1 / statistics.median(self.steps())

    def gap(self):
        return max(self.steps())

    def gap_begin(self):
        return self.times()[self.steps().index(self.gap())]

    def age(self):
        return statistics.median(b - a for a, b in zip(self.stamps, self.arrivals, strict=True))

    def reliability(self):
        return self.get_publishers_info_by_topic("/scan")[0].qos_profile.reliability.name.lower()

    def values(self):
        return {
            "reliability": self.reliability(),
            "rate": self.rate(),
            "gap": self.gap(),
            "gap_begin": self.gap_begin(),
            "age": self.age(),
            "static_transforms": self.statics,
        }

    def report(self):
        if len(self.stamps) > 2:
            pairs = [KeyValue(key=key, value=str(value)) for key, value in self.values().items()]
            self.publisher.publish(DiagnosticStatus(name="bag", values=pairs))


class Arrays(Node):
    """A design of its own: numpy, and one report at the end, once nothing has arrived for a second."""

    def __init__(self):
        super().__init__("arrays")
        self.rows, self.frames, self.done = [], set(), False
        self.out = self.create_publisher(DiagnosticStatus, "bag_report", 1)
        self.create_subscription(LaserScan, "scan", self.note, QoSProfile(depth=200, reliability=ReliabilityPolicy.BEST_EFFORT))
        self.create_subscription(TFMessage, "tf_static", self.mount, QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL))
        self.create_timer(0.5, self.look)

    def now(self):
        return self.get_clock().now().nanoseconds * 1e-9

    def note(self, scan):
        self.rows.append((scan.header.stamp.sec + scan.header.stamp.nanosec * 1e-9, self.now()))

    def mount(self, msg):
        self.frames |= {each.child_frame_id for each in msg.transforms}

    def look(self):
        if self.done or not self.rows or self.now() - self.rows[-1][1] < 3.0:
            return
        self.done = True
        measured, arrived = np.array(self.rows).T
        steps = np.diff(measured)
        first = int(np.argmax(steps))
        best_effort = ReliabilityPolicy.BEST_EFFORT
        offered = [end.qos_profile.reliability for end in self.get_publishers_info_by_topic("/scan")]
        values = {
            "reliability": "best_effort" if best_effort in offered else "reliable",
            "rate": f"{1 / np.median(steps):.3f}",
            "gap": f"{steps[first]:.3f}",
            "gap_begin": f"{measured[first]:.6f}",
            "age": f"{np.median(arrived - measured):.4f}",
            "static_transforms": f"{len(self.frames)}",
        }
        self.out.publish(DiagnosticStatus(values=[KeyValue(key=key, value=values[key]) for key in values]))


def main():
    """A main without a class, which keeps dictionaries."""
    rclpy.init()
    node = rclpy.create_node("bag_report")
    scans, static = {}, []
    clock = node.get_clock()

    def on_scan(scan):
        stamp = scan.header.stamp
        scans[stamp.sec * 10**9 + stamp.nanosec] = clock.now().nanoseconds

    def report():
        if len(scans) < 3:
            return
        steps = {before: after - before for before, after in itertools.pairwise(sorted(scans))}
        begin = max(steps, key=steps.get)
        (publisher, *_) = node.get_publishers_info_by_topic("/scan")
        found = {
            "rate": 1e9 / statistics.median(steps.values()),
            "gap": steps[begin] / 1e9,
            "gap_begin": begin / 1e9,
            "age": statistics.median(arrived - measured for measured, arrived in scans.items()) / 1e9,
            "reliability": publisher.qos_profile.reliability.name.lower(),
            "static_transforms": len(static),
        }
        out.publish(DiagnosticStatus(values=[KeyValue(key=key, value=str(found[key])) for key in sorted(found)]))

    out = node.create_publisher(DiagnosticStatus, "/bag_report", 10)
    node.create_subscription(LaserScan, "/scan", on_scan, qos_profile_sensor_data)
    node.create_subscription(TFMessage, "/tf_static", lambda msg: static.extend(msg.transforms), LATCHED)
    node.create_timer(1.0, report)
    rclpy.spin(node)


class Histogram(Node):
    """A design of its own: counts steps and ages by the millisecond, and keeps no list of scans."""

    def __init__(self):
        super().__init__("histogram")
        self.steps, self.ages, self.statics = Counter(), Counter(), 0
        self.last, self.longest = None, (0, 0)
        self.out = self.create_publisher(DiagnosticStatus, "/bag_report", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(TFMessage, "/tf_static", self.on_static, LATCHED)
        self.create_timer(1.0, self.report)

    def on_static(self, msg):
        self.statics += len(msg.transforms)

    def on_scan(self, scan):
        measured = Time.from_msg(scan.header.stamp).nanoseconds
        self.ages[round((self.get_clock().now().nanoseconds - measured) / 1e6)] += 1
        if self.last is not None:
            step = measured - self.last
            self.steps[round(step / 1e6)] += 1
            self.longest = max(self.longest, (step, self.last))
        self.last = measured

    def report(self):
        if self.steps:
            (usual, _), *_ = self.steps.most_common(1)
            gap, begin = self.longest
            offered = self.get_publishers_info_by_topic("/scan")[0].qos_profile.reliability
            self.send({
                "reliability": "reliable" if offered == ReliabilityPolicy.RELIABLE else "best_effort",
                "rate": 1000 / usual,
                "gap": gap / 1e9,
                "gap_begin": begin / 1e9,
                "age": statistics.median(self.ages.elements()) / 1000,
                "static_transforms": self.statics,
            })  # fmt: skip

    def send(self, values):
        status = DiagnosticStatus()
        for key, value in values.items():
            status.values.append(KeyValue(key=key, value=str(value)))
        self.out.publish(status)


@dataclass
class _Scan:
    measured: int
    arrived: int

    @property
    def age(self):
        return self.arrived - self.measured


class AllAtOnce(Node):
    """A design of its own: callbacks only collect; functions without a state compute everything."""

    def __init__(self):
        super().__init__("all_at_once")
        self.scans, self.transforms = [], {}
        self.publisher = self.create_publisher(DiagnosticStatus, "bag_report", 10)
        self.create_subscription(LaserScan, "scan", self.scan, QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT))
        self.create_subscription(TFMessage, "tf_static", self.tf, QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL))
        self.create_timer(0.25, self.tick)

    def scan(self, msg):
        self.scans.append(_Scan(Time.from_msg(msg.header.stamp).nanoseconds, self.get_clock().now().nanoseconds))

    def tf(self, msg):
        self.transforms.update({(each.header.frame_id, each.child_frame_id): each for each in msg.transforms})

    def tick(self):
        if len(self.scans) < 10:
            return
        infos = self.get_publishers_info_by_topic("/scan")
        values = _summary(self.scans) | {
            "reliability": {info.qos_profile.reliability for info in infos}.pop().name.lower(),
            "static_transforms": len(self.transforms),
        }
        self.publisher.publish(DiagnosticStatus(
            level=DiagnosticStatus.OK, name="report", message="",
            values=[KeyValue(key=key, value=f"{value}") for key, value in values.items()],
        ))  # fmt: skip


def _summary(scans):
    pairs = list(itertools.pairwise(sorted(scans, key=lambda scan: scan.measured)))
    first, second = max(pairs, key=lambda pair: pair[1].measured - pair[0].measured)
    return {
        "rate": 1e9 / statistics.median(b.measured - a.measured for a, b in pairs),
        "gap": (second.measured - first.measured) / 1e9,
        "gap_begin": first.measured / 1e9,
        "age": statistics.median(scan.age for scan in scans) / 1e9,
    }


class SortedLists(Node):
    """A design of its own: the steps and ages are always sorted, so that the middle one is the median."""

    def __init__(self):
        super().__init__("sorted_lists")
        self.steps, self.ages, self.count = [], [], 0
        self.before = self.gap = self.begin = None
        self.publisher = self.create_publisher(DiagnosticStatus, "/bag_report", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(TFMessage, "/tf_static", self.on_static, LATCHED)
        self.create_timer(1.0, self.report)

    def on_static(self, msg):
        for _ in msg.transforms:
            self.count += 1

    def on_scan(self, scan):
        stamp = Time.from_msg(scan.header.stamp)
        bisect.insort(self.ages, self.get_clock().now() - stamp)
        if self.before is not None:
            step = stamp - self.before
            bisect.insort(self.steps, step)
            if self.gap is None or step > self.gap:
                self.gap, self.begin = step, self.before
        self.before = stamp

    def report(self):
        if not self.steps:
            return
        middle, age = self.steps[len(self.steps) // 2], self.ages[len(self.ages) // 2]
        values = {
            "static_transforms": str(self.count),
            "age": f"{age.nanoseconds / 1e9:.5f}",
            "gap_begin": f"{self.begin.nanoseconds / 1e9:.4f}",
            "gap": f"{self.gap.nanoseconds / 1e9:.4f}",
            "rate": f"{1e9 / middle.nanoseconds:.4f}",
        }
        for info in self.get_publishers_info_by_topic("/scan"):
            values["reliability"] = info.qos_profile.reliability.name.lower()
        self.publisher.publish(DiagnosticStatus(values=[KeyValue(key=k, value=v) for k, v in values.items()]))


class Trimmed(Report):
    """A design of its own: the mean of the steps and ages in the middle half."""

    def middle(self, numbers):
        ordered = sorted(numbers)
        part = len(ordered) // 4
        return statistics.fmean(ordered[part : len(ordered) - part])

    def rate(self):
        return 1 / self.middle(self.steps())

    def age(self):
        return self.middle(b - a for a, b in zip(self.stamps, self.arrivals, strict=True))


class WithoutTheGap(Report):
    """A design of its own: the rate is the number of steps by their time, without those of the silence."""

    def rate(self):
        usual = min(self.steps())
        good = [step for step in self.steps() if step < 1.5 * usual]
        return len(good) / sum(good)


class Collecting(Node):
    """A design of its own: a generator receives the scans, and yields what is known so far."""

    def __init__(self):
        super().__init__("collecting")
        self.known, self.frames = {}, []
        self.collector = self.collect()
        next(self.collector)
        self.publisher = self.create_publisher(DiagnosticStatus, "/bag_report", 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(TFMessage, "/tf_static", lambda msg: self.frames.extend(msg.transforms), LATCHED)
        self.create_timer(1.0, self.report)

    def collect(self):
        stamps, ages, known = [], [], {}
        while True:
            stamp, age = yield known
            stamps.append(stamp)
            ages.append(age)
            if len(stamps) > 1:
                steps = np.diff(stamps)
                known = {"rate": 1 / np.median(steps), "gap": steps.max(), "age": np.median(ages)}
                known["gap_begin"] = stamps[steps.argmax()]

    def on_scan(self, scan):
        stamp = scan.header.stamp.sec + scan.header.stamp.nanosec / 1e9
        self.known = self.collector.send((stamp, self.get_clock().now().nanoseconds / 1e9 - stamp))

    def report(self):
        if self.known:
            (offered,) = {info.qos_profile.reliability for info in self.get_publishers_info_by_topic("/scan")}
            more = {"reliability": offered.name.lower(), "static_transforms": len(self.frames)}
            pairs = [KeyValue(key=key, value=str(value)) for key, value in (self.known | more).items()]
            self.publisher.publish(DiagnosticStatus(values=pairs))


class ByTheArrivals(Report):
    def times(self):
        return self.arrivals


class MeanRate(Report):
    def rate(self):
        return 1 / statistics.mean(self.steps())


class Period(Report):
    def rate(self):
        return statistics.median(self.steps())


class RateOfTheDataSheet(Report):
    def rate(self):
        return 20.0


class AlwaysSevenTransforms(Report):
    def values(self):
        return super().values() | {"static_transforms": 7}


class MeanAge(Report):
    def age(self):
        return statistics.mean(b - a for a, b in zip(self.stamps, self.arrivals, strict=True))


class SignTurned(Report):
    def age(self):
        return -super().age()


class SinceTheStart(Report):
    def gap_begin(self):
        return super().gap_begin() - self.stamps[0]


class DefaultQoS(Report):
    scan_qos = 10


class CountsMessages(Report):
    def on_static(self, msg):
        self.statics += 1


class AssumesBestEffort(Report):
    def reliability(self):
        return "best_effort"


class WaitsForTheTransform(Report):
    def __init__(self):
        super().__init__()
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)

    def report(self):
        if self.buffer.can_transform("base_link", "base_scan", Time()):
            super().report()


class OnlyOneKey(Report):
    def values(self):
        return {"rate": self.rate()}


class NoValues(Report):
    def values(self):
        return {}
