"""Doctors of bags: right ones, and wrong ones named after their defect."""

import itertools
import math
import statistics

import numpy as np
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SENSOR = QoSProfile(depth=50, reliability=qos_profile_sensor_data.reliability)
PARTS = "_seconds", "_yaw_of"


def _seconds(stamp):
    return stamp.sec + stamp.nanosec / 1e9


def _yaw_of(rotation):
    return 2 * math.atan2(rotation.z, rotation.w)


class Doctor(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("doctor")
        self.odom, self.gyro, self.scans = [], [], []  # rows that begin with stamp and arrival, s
        self.mounts = {}  # frame: arrival, x, y, yaw
        self.found, self.last = None, 0.0
        self.publisher = self.create_publisher(DiagnosticStatus, "/diagnosis", 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 50)
        self.create_subscription(Imu, "/imu/data", self.on_imu, SENSOR)
        self.create_subscription(LaserScan, "/scan", self.on_scan, SENSOR)
        self.create_subscription(TFMessage, "/tf_static", self.on_static, LATCHED)
        self.create_timer(1.0, self.report)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_odom(self, msg):
        pose, twist = msg.pose.pose, msg.twist.twist
        place = pose.position.x, pose.position.y, _yaw_of(pose.orientation)
        self.last = self.now()
        self.odom.append((_seconds(msg.header.stamp), self.last, *place, twist.linear.x, twist.angular.z))

    def on_imu(self, msg):
        self.gyro.append((_seconds(msg.header.stamp), self.now(), msg.angular_velocity.z))

    def on_scan(self, msg):
        self.scans.append((_seconds(msg.header.stamp), self.now(), msg))

    def on_static(self, msg):
        for each in msg.transforms:
            move = each.transform
            place = move.translation.x, move.translation.y, _yaw_of(move.rotation)
            self.mounts[each.child_frame_id] = (self.now(), *place)

    def report(self):
        if self.found is None and self.odom and self.now() - self.last > 1.5:
            self.found = self.diagnose()
        if self.found is not None:
            self.publish(*self.found)

    def publish(self, name, amount=0.0, topic="", stamp=0.0):
        values = {"amount": f"{amount:.4f}", "topic": topic, "stamp": f"{stamp:.6f}"}
        pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
        self.publisher.publish(DiagnosticStatus(name=name, values=pairs))

    def diagnose(self):
        tests = self.transform, self.clock, self.doubled, self.wheels, self.lidar
        return next((found for test in tests if (found := test())), ("none",))

    def transform(self):
        frame, first, last = self.scans[0][2].header.frame_id, self.scans[0][1], self.scans[-1][1]
        arrived = self.mounts[frame][0] if frame in self.mounts else last
        if arrived - first > 1.0:
            return "missing_transform", arrived - first, "/tf_static", self.scans[0][0]
        return None

    def ages(self, rows):
        return [row[1] - row[0] for row in rows]

    def clock(self):
        for topic, rows in (("/scan", self.scans), ("/imu/data", self.gyro)):
            ages, part = self.ages(rows), len(rows) // 5
            jump = statistics.median(ages[:part]) - statistics.median(ages[-part:])
            if abs(jump) > 0.08:
                return "clock_offset", jump, topic, rows[-1][0]
        return None

    def doubled(self):
        jumps = []
        for one, other in itertools.pairwise(self.odom):
            step = math.dist(one[2:4], other[2:4])
            if step > abs(one[5]) * 0.1 + 0.1:
                jumps.append((step, other[0]))
        if len(jumps) > 10:
            return "two_odometries", statistics.median(step for step, _ in jumps), "/odom", jumps[-1][1]
        return None

    def rates(self):
        """The turning rates by odometry and by the gyro, without its bias, and when."""
        odom, gyro = np.array(self.odom), np.array(self.gyro)
        rates = np.interp(odom[:, 0], gyro[:, 0], gyro[:, 2])
        rests = (np.abs(odom[:, 5]) < 0.01) & (np.abs(odom[:, 6]) < 0.01)
        first = np.argmin(rests)  # the first at which it moves
        return odom[:, 6], rates - rates[:first].mean(), odom[:, 0]

    def wheels(self):
        wheels, gyro, stamps = self.rates()
        factor = float(np.sum(wheels * gyro) / np.sum(gyro * gyro))
        if abs(factor - 1.0) > 0.03:
            return "wheel_radius", factor, "/odom", float(stamps[np.argmax(np.abs(gyro))])
        return None

    def clouds(self):
        """The lidar's points of some scans in base_link, and the robot's poses."""
        poses = np.array(self.odom)
        poses[:, 4] = np.unwrap(poses[:, 4])
        for stamp, _, scan in self.scans[::8]:
            ranges = np.array(scan.ranges)
            angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
            good = np.isfinite(ranges)
            pose = [float(np.interp(stamp, poses[:, 0], poses[:, i])) for i in (2, 3, 4)]
            yield ranges[good], angles[good], pose

    def cells(self, clouds, turned):
        _, x, y, yaw = self.mounts[self.scans[0][2].header.frame_id]
        points = []
        for ranges, angles, (px, py, turn) in clouds:
            ahead = x + ranges * np.cos(angles + yaw + turned)
            aside = y + ranges * np.sin(angles + yaw + turned)
            cos, sin = math.cos(turn), math.sin(turn)
            points.append(np.column_stack([px + cos * ahead - sin * aside, py + sin * ahead + cos * aside]))
        return len(np.unique(np.floor(np.concatenate(points) / 0.05), axis=0))

    def sharpest(self):
        clouds = list(self.clouds())
        best = 0.0
        for width, step in ((18.0, 2.0), (2.0, 0.5)):
            tries = [best + math.radians(d) for d in np.arange(-width, width + 0.1, step)]
            best = min(tries, key=lambda angle: self.cells(clouds, angle))
        return best

    def lidar(self):
        angle = self.sharpest()
        if abs(angle) > math.radians(3.0):
            moving = [row[0] for row in self.odom if row[5] > 0.2]
            return "lidar_yaw", angle, "/scan", moving[len(moving) // 2]
        return None


class Agreement(Doctor):
    """A design of its own: the angle at which most scans agree on the same cells."""

    def cells(self, clouds, turned):
        _, x, y, yaw = self.mounts[self.scans[0][2].header.frame_id]
        grid = {}
        for number, (ranges, angles, (px, py, turn)) in enumerate(clouds[::2]):
            ahead = x + ranges * np.cos(angles + yaw + turned)
            aside = y + ranges * np.sin(angles + yaw + turned)
            cos, sin = math.cos(turn), math.sin(turn)
            columns = np.floor((px + cos * ahead - sin * aside) / 0.06).astype(int)
            rows = np.floor((py + sin * ahead + cos * aside) / 0.06).astype(int)
            for cell in set(zip(columns.tolist(), rows.tolist(), strict=True)):
                grid.setdefault(cell, set()).add(number)
        return -sum(len(seen) ** 2 for seen in grid.values())  # cells that many scans agree on


class ByIntegration(Doctor):
    """A design of its own: the angle turned by the wheels and by the gyro, added up."""

    def wheels(self):
        wheels, gyro, stamps = self.rates()
        steps = np.diff(stamps, prepend=stamps[0])
        factor = float(np.sum(np.abs(wheels) * steps) / np.sum(np.abs(gyro) * (np.abs(gyro) > 0.05) * steps))
        if abs(factor - 1.0) > 0.035:
            fast = np.abs(gyro) > 0.15
            slope = np.polyfit(gyro[fast], wheels[fast], 1)[0]
            return "wheel_radius", float(slope), "/tf", float(stamps[fast][0])
        return None


class Alternates(Doctor):
    """A design of its own: two odometries are two clusters of the difference to the path of the first."""

    def doubled(self):
        offsets = []
        for a, b, c in zip(self.odom, self.odom[1:], self.odom[2:], strict=False):
            middle = (a[2] + c[2]) / 2, (a[3] + c[3]) / 2
            if math.dist(a[2:4], c[2:4]) < 0.06:
                offsets.append((math.dist(middle, b[2:4]), b[0]))
        far = [row for row in offsets if row[0] > 0.1]
        if len(far) > 10:
            return "two_odometries", statistics.median(step for step, _ in far), "/tf", far[0][1]
        return None


class SlidingAge(Doctor):
    """A design of its own: the largest change of the age between windows of a second."""

    def clock(self):
        found = {}
        for topic, rows in (("/scan", self.scans), ("/imu/data", self.gyro)):
            ages = np.array(self.ages(rows))
            window = max(10, len(ages) // 31)
            medians = [float(np.median(ages[i : i + window])) for i in range(0, len(ages) - window, window)]
            found[topic] = (medians[0] - medians[-1], rows[-window][0])
        topic = max(found, key=lambda name: abs(found[name][0]))
        jump, stamp = found[topic]
        return ("clock_offset", jump, topic, stamp) if abs(jump) > 0.1 else None


class Fits(Doctor):
    """A design of its own: the lowest point of a parabola through the counts of cells."""

    def sharpest(self):
        clouds = list(self.clouds())
        tries = np.radians(np.arange(-20.0, 20.1, 1.0))
        counts = np.array([self.cells(clouds, angle) for angle in tries], dtype=float)
        best = int(np.clip(np.argmin(counts), 2, len(tries) - 3))
        near = slice(best - 2, best + 3)
        a, b, _ = np.polyfit(tries[near], counts[near], 2)
        return float(-b / (2 * a)) if a > 0 else float(tries[best])


class AtTheEnd(Doctor):
    """A design of its own: all tests at once, and the most certain one is reported."""

    def diagnose(self):
        tests = self.transform, self.doubled, self.clock, self.wheels, self.lidar
        found = [result for test in tests if (result := test())]
        return found[0] if found else ("none",)


class Entropy(Doctor):
    """A design of its own: the angle with the lowest entropy of the points over the cells."""

    def cells(self, clouds, turned):
        _, x, y, yaw = self.mounts[self.scans[0][2].header.frame_id]
        points = []
        for ranges, angles, (px, py, turn) in clouds:
            ahead = x + ranges * np.cos(angles + yaw + turned)
            aside = y + ranges * np.sin(angles + yaw + turned)
            cos, sin = math.cos(turn), math.sin(turn)
            points.append(np.column_stack([px + cos * ahead - sin * aside, py + sin * ahead + cos * aside]))
        _, counts = np.unique(np.floor(np.concatenate(points) / 0.08), axis=0, return_counts=True)
        shares = counts / counts.sum()
        return -float(shares @ np.log(shares))


class StepFit(Doctor):
    """A design of its own: the step that fits the ages of a sensor best, by least squares."""

    def clock(self):
        for topic, rows in (("/scan", self.scans), ("/imu/data", self.gyro)):
            ages, best = np.array(self.ages(rows)), (math.inf, 0.0, 0)
            for cut in range(len(ages) // 10, len(ages) - len(ages) // 10, max(1, len(ages) // 200)):
                before, after = np.median(ages[:cut]), np.median(ages[cut:])
                miss = np.abs(ages[:cut] - before).sum() + np.abs(ages[cut:] - after).sum()
                best = min(best, (float(miss), float(before - after), cut))
            _, jump, cut = best
            if abs(jump) > 0.08:
                return "clock_offset", jump, topic, rows[cut + (len(rows) - cut) // 2][0]
        return None


class MedianRatio(Doctor):
    """A design of its own: the wheels' factor is the median of the ratios in turns."""

    def wheels(self):
        wheels, gyro, stamps = self.rates()
        turns = np.abs(gyro) > 0.3
        factor = float(np.median(wheels[turns] / gyro[turns]))
        if abs(factor - 1.0) > 0.03:
            return "wheel_radius", factor, "/tf", float(stamps[turns][-1])
        return None


class ImpliedSpeed(Doctor):
    """A design of its own: between two messages of two odometries the robot would be faster than it can be."""

    def doubled(self):
        steps = []
        for one, other in itertools.pairwise(sorted(self.odom)):
            if other[0] > one[0] and math.dist(one[2:4], other[2:4]) / (other[0] - one[0]) > 3.0:
                steps.append((math.dist(one[2:4], other[2:4]), one[0]))
        if len(steps) < 20:
            return None
        return "two_odometries", statistics.median(step for step, _ in steps), "/odom", steps[len(steps) // 2][1]


class AlwaysNone(Doctor):
    def diagnose(self):
        return ("none",)


class AlwaysTheClock(Doctor):
    def diagnose(self):
        return "clock_offset", 0.3, "/scan", self.scans[-1][0]


class AlwaysTheLidar(Doctor):
    def diagnose(self):
        return "lidar_yaw", 0.17, "/scan", self.scans[-1][0]


class NamesTheSymptom(Doctor):
    def diagnose(self):
        name, *rest = super().diagnose()
        return ("walls_are_thick", *rest) if name == "lidar_yaw" else (name, *rest)


class AgeIsTheClock(Doctor):
    """Takes a slow network for a wrong clock."""

    def clock(self):
        for topic, rows in (("/scan", self.scans), ("/imu/data", self.gyro)):
            age = statistics.median(self.ages(rows)[-100:])
            if abs(age) > 0.08:
                return "clock_offset", -age, topic, rows[-1][0]
        return None


class MeanOfTheWholeBag(Doctor):
    def clock(self):
        found = super().clock()
        return found and (found[0], found[1] / 2, *found[2:])


class ClockSignTurned(Doctor):
    def clock(self):
        found = super().clock()
        return found and (found[0], -found[1], *found[2:])


class StampBeforeTheJump(Doctor):
    def clock(self):
        found = super().clock()
        return found and (*found[:3], self.scans[0][0])


class RateIsTwoOdometries(Doctor):
    """Takes 40 Hz for two publishers."""

    def doubled(self):
        if len(self.odom) > 1.2 * len(self.scans):
            return super().doubled() or ("two_odometries", 0.5, "/odom", self.odom[-1][0])
        return None


class KeepsOneStaticMessage(Doctor):
    def on_static(self, msg):
        self.mounts.clear()
        super().on_static(msg)


class ForgetsTheMount(Doctor):
    """Takes the lidar as if it looked ahead."""

    def on_static(self, msg):
        super().on_static(msg)
        self.mounts = {frame: (mount[0], 0.0, 0.0, 0.0) for frame, mount in self.mounts.items()}

    def sharpest(self):
        clouds = list(self.clouds())
        tries = np.radians(np.arange(-180.0, 180.0, 2.0))
        return float(min(tries, key=lambda angle: self.cells(clouds, angle)))


class WithTheBias(Doctor):
    """Doesn't subtract the gyro's bias, and sums up."""

    def wheels(self):
        odom, gyro = np.array(self.odom), np.array(self.gyro)
        rates = np.interp(odom[:, 0], gyro[:, 0], gyro[:, 2])
        factor = float(np.sum(odom[:, 6]) / np.sum(rates))
        moving = [row[0] for row in self.odom if row[5] > 0.2]
        return ("wheel_radius", factor, "/odom", moving[0]) if abs(factor - 1.0) > 0.03 else None


class FactorUpsideDown(Doctor):
    def wheels(self):
        found = super().wheels()
        return found and (found[0], 1 / found[1], *found[2:])


class Degrees(Doctor):
    def lidar(self):
        found = super().lidar()
        return found and (found[0], math.degrees(found[1]), *found[2:])


class EvidenceAtRest(Doctor):
    """Gives the first stamp as evidence, at which the robot stands."""

    def diagnose(self):
        name, *rest = super().diagnose()
        return (name, *rest[:2], self.odom[0][0]) if rest else (name,)


class NoEvidence(Doctor):
    def diagnose(self):
        return super().diagnose()[:2]


class OnlyTheName(Doctor):
    def publish(self, name, *rest):
        self.publisher.publish(DiagnosticStatus(name=name))


class WrongTopic(Doctor):
    def diagnose(self):
        found = super().diagnose()
        return (*found[:2], "/cmd_vel", *found[3:]) if len(found) > 1 else found


class CountsScans(Doctor):
    """Reports how many scans have no transform, in place of seconds."""

    def transform(self):
        found = super().transform()
        return found and (found[0], 20 * found[1], *found[2:])


class ReliableScans(Doctor):
    """Requests reliable scans, which the lidar doesn't offer."""

    def create_subscription(self, kind, topic, callback, qos):
        return super().create_subscription(kind, topic, callback, 10 if kind is LaserScan else qos)


class Unpublished(Doctor):
    def publish(self, *found):
        pass
