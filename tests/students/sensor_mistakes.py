"""Nodes with one mistake each around what sensors say and what one reckons from it, named by it."""

import math

import numpy as np
from diagnostic_msgs.msg import DiagnosticStatus
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import Imu, LaserScan


class Looker(Node):
    """Looks at a scan and at an IMU's message, and says nothing; nothing is wrong with it."""

    def __init__(self):
        super().__init__("looker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.look(LaserScan(ranges=[1.0, 2.0]), Imu())

    def look(self, scan, imu):
        return min(scan.ranges) < 1.0 and imu.angular_velocity.z * 0.01


class ComparesAllRanges(Looker):
    def look(self, scan, imu):
        return scan.ranges < 1.0


class AddsUpVectors(Looker):
    def look(self, scan, imu):
        return imu.angular_velocity * 0.01


class LeastOfNothing(Looker):
    def look(self, scan, imu):
        return min(distance for distance in scan.ranges if distance > 3.0)


class LeastOfAnEmptyArray(Looker):
    def look(self, scan, imu):
        ranges = np.array(scan.ranges)
        return ranges[ranges > 3.0].min()


class ReshapesByWidth(Looker):
    def look(self, scan, imu):
        return np.zeros(4 * 8, np.uint8).reshape(4, 2, 3)


class TakesAStampFromATime(Looker):
    def look(self, scan, imu):
        return self.get_clock().now() - scan.header.stamp


class DurationForAMessage(Looker):
    def look(self, scan, imu):
        return NavigateToPose.Feedback(estimated_time_remaining=Duration(seconds=1.5))


class LevelAsANumber(Looker):
    def look(self, scan, imu):
        return DiagnosticStatus(name="lidar", level=1)


class TooShallow(Looker):
    def look(self, scan, imu):
        return Odometry().pose.orientation


class ForgetsToReturn(Looker):
    def look(self, scan, imu):
        distance, bearing = self.polar(3.0, 4.0)
        return distance, bearing

    def polar(self, x, y):
        math.hypot(x, y), math.atan2(y, x)


class QueueOfNumbers(Looker):
    def look(self, scan, imu):
        _, cell = min([2.0, 1.0])
        return cell


class IndexForAList(Looker):
    def look(self, scan, imu):
        return list(scan.ranges.index(2.0))


class DistanceForAPoint(Looker):
    def look(self, scan, imu):
        return math.dist((0.0, 0.0), (1.0, 1.0))[0]


class ColumnForRow(Looker):
    def look(self, scan, imu):
        return np.zeros((2, 5))[3, 1]


class CellNeverSeen(Looker):
    def look(self, scan, imu):
        return {(0, 0): None}[4, 34]


class BeforeTheStart(Looker):
    def look(self, scan, imu):
        came_from = {(0, 0): None}
        return came_from[came_from[0, 0]]


class OnTopOfThePoint(Looker):
    def look(self, scan, imu):
        return 2.0 / math.dist((1.0, 1.0), (1.0, 1.0))


class MeanOfNothing(Looker):
    def look(self, scan, imu):
        far = [distance for distance in scan.ranges if distance > 100]
        return sum(far) / len(far)


class AsksTheRangesForTheLeast(Looker):
    def look(self, scan, imu):
        return scan.ranges.min()


class DividesInPlaceOfAComma(Looker):
    def look(self, scan, imu):
        return math.atan2(imu.orientation.z / imu.orientation.w)


class BiasOfAnotherBranch(Looker):
    def look(self, scan, imu):
        if imu.angular_velocity.z > 0:
            bias = 0.1
        return imu.angular_velocity.z - bias


class WayTurnedInPlace(Looker):
    def look(self, scan, imu):
        way = [(0, 0), (0, 1)]
        return [cell[0] for cell in way.reverse() or None]


class CostNeverNoted(Looker):
    def look(self, scan, imu):
        return {}.get((0, 0)) < 1.0


class DistanceForAPlace(Looker):
    def look(self, scan, imu):
        return scan.ranges.tolist()[min(scan.ranges) :]


class LooksBackFromTimeZero(Looker):
    def look(self, scan, imu):
        return Time() - Duration(seconds=60)


class ComparesWithTheSystemsTime(Looker):
    def look(self, scan, imu):
        return self.get_clock().now() < Time(seconds=3)


class ReadsAngles(Node):
    """Right: it counts the rays of the robot's scans."""

    def __init__(self):
        super().__init__("angles")
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_scan(self, scan):
        self.use(np.array(scan.ranges), self.angles(scan))

    def angles(self, scan):
        return scan.angle_min + np.arange(len(scan.ranges)) * scan.angle_increment

    def use(self, ranges, angles):
        return ranges * np.cos(angles)


class OneAngleShort(ReadsAngles):
    def angles(self, scan):
        return np.arange(scan.angle_min, scan.angle_max, scan.angle_increment)


class AngleOfEachRay(OneAngleShort):
    def use(self, ranges, angles):
        return [angles[ray] for ray in range(len(ranges))]


class AnglesOfNearRays(OneAngleShort):
    def use(self, ranges, angles):
        return angles[ranges < 1.0]


class AnglesInAList(ReadsAngles):
    def on_scan(self, scan):
        angles = np.arange(scan.angle_min, scan.angle_max, scan.angle_increment).tolist()
        return [angles[ray] for ray, _ in enumerate(scan.ranges)]


class OneAngleShortAndAnotherIndex(OneAngleShort):
    def use(self, ranges, angles):
        return [1.0, 2.0][2]
