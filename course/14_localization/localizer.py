"""The localization of lesson 14c as a node, with AMCL's topics. What it computes is in particles.py."""

import math
import signal

import numpy as np
import rclpy
from geometry_msgs.msg import Pose, PoseWithCovarianceStamped, TransformStamped
from nav2_msgs.msg import Particle, ParticleCloud
from nav_msgs.msg import OccupancyGrid
from particles import ParticleFilter, compose, inverse, wrapped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_ros import Buffer, TransformBroadcaster, TransformException, TransformListener

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TOLERANCE = Duration(seconds=0.2)  # so long a transform is good for. In AMCL: transform_tolerance
MOVED, TURNED = (
    0.1,
    0.1,
)  # m, rad: until then, a new scan says nothing new. In AMCL: update_min_d, update_min_a
KEPT = 0, 1, 5  # of the six rows of a message's covariance: x, y and yaw


class Localizer(Node):
    """Publishes where odom is in map, as AMCL does: the odometry's drift, corrected by scans."""

    count = 500  # particles. In AMCL: max_particles
    beams = 30  # rays of a scan that it uses. In AMCL: max_beams
    everywhere = False  # whether it begins all over the map, in place of waiting for /initialpose

    def __init__(self):
        super().__init__("localizer")
        self.rng = np.random.default_rng()
        self.filter = self.odometry = self.weighed_at = None
        self.begun = self.everywhere
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.broadcaster = TransformBroadcaster(self)
        self.pose_publisher = self.create_publisher(PoseWithCovarianceStamped, "/amcl_pose", LATCHED)
        self.cloud_publisher = self.create_publisher(ParticleCloud, "/particle_cloud", 10)
        self.create_subscription(OccupancyGrid, "/map", self.on_map, LATCHED)
        self.create_subscription(PoseWithCovarianceStamped, "/initialpose", self.on_initialpose, 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.create_timer(1.0, self.publish_cloud)

    # -- what it receives --

    def on_map(self, msg):
        """Make a filter, with particles all over the map."""
        cells = np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
        origin = msg.info.origin.position.x, msg.info.origin.position.y
        self.filter = ParticleFilter(cells, msg.info.resolution, origin, self.count, self.rng)

    def on_initialpose(self, msg):
        """Begin again around a pose: a person has said where the robot is."""
        if self.filter is not None:
            covariance = np.reshape(msg.pose.covariance, (6, 6))[np.ix_(KEPT, KEPT)]
            position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
            self.filter.start((position.x, position.y, yaw), covariance)
            self.begun, self.weighed_at = True, None

    def on_scan(self, scan):
        """Move the particles as the odometry has moved, weigh them, and publish the result."""
        try:
            odometry = self.where("odom", "base_link", scan.header.stamp)
            lidar = self.where("base_link", scan.header.frame_id, scan.header.stamp)
        except TransformException:
            return  # not known yet; the next scan comes soon
        if self.filter is None or not self.begun:
            return
        if self.odometry is not None:
            self.filter.move(compose(inverse(self.odometry), odometry))
        self.odometry = odometry
        if self.has_moved(odometry):
            self.update(points_of(scan, lidar, self.beams))
            self.weighed_at = odometry
        self.publish(scan.header.stamp, odometry)

    # -- what it does --

    def where(self, parent, child, stamp):
        """x, y and yaw of a frame in another one at that time; raises TransformException where unknown."""
        found = self.buffer.lookup_transform(parent, child, stamp).transform
        return found.translation.x, found.translation.y, yaw_of(found.rotation)

    def has_moved(self, odometry):
        """Whether the robot has moved since a scan was last used."""
        if self.weighed_at is None:
            return True
        forward, left, turn = compose(inverse(self.weighed_at), odometry)
        return math.hypot(forward, left) > MOVED or abs(wrapped(turn)) > TURNED

    def update(self, points):
        """Use a scan."""
        self.filter.weigh(points)
        self.filter.resample()

    def publish(self, stamp, odometry):
        """Publish the pose, and the transform that takes the odometry there."""
        pose, covariance = self.filter.estimate()
        sent = PoseWithCovarianceStamped()
        sent.header.frame_id, sent.header.stamp = "map", stamp
        sent.pose.pose = pose_of(pose)
        whole = np.zeros((6, 6))
        whole[np.ix_(KEPT, KEPT)] = covariance
        sent.pose.covariance = whole.ravel()
        self.pose_publisher.publish(sent)
        x, y, yaw = compose(pose, inverse(odometry))  # map -> base_link, then back: base_link -> odom
        transform = TransformStamped(child_frame_id="odom")
        transform.header.frame_id = "map"
        transform.header.stamp = (Time.from_msg(stamp) + TOLERANCE).to_msg()
        transform.transform.translation.x, transform.transform.translation.y = x, y
        transform.transform.rotation = pose_of((x, y, yaw)).orientation
        self.broadcaster.sendTransform(transform)

    def publish_cloud(self):
        """Publish all particles, for people to look at."""
        if self.filter is None or not self.begun:
            return
        cloud = ParticleCloud()
        cloud.header.frame_id, cloud.header.stamp = "map", self.get_clock().now().to_msg()
        pairs = zip(self.filter.poses.tolist(), self.filter.weights.tolist(), strict=True)
        cloud.particles = [Particle(pose=pose_of(pose), weight=weight) for pose, weight in pairs]
        self.cloud_publisher.publish(cloud)


# -- messages --


def yaw_of(orientation):
    """The yaw of a quaternion, in rad."""
    return 2 * math.atan2(orientation.z, orientation.w)


def pose_of(values):
    """A Pose from x, y and yaw."""
    pose = Pose()
    pose.position.x, pose.position.y = float(values[0]), float(values[1])
    pose.orientation.z, pose.orientation.w = math.sin(values[2] / 2), math.cos(values[2] / 2)
    return pose


def points_of(scan, lidar, beams):
    """Where some rays of a scan ended, in base_link; `lidar` is the lidar's pose there."""
    ranges = np.array(scan.ranges)
    angles = lidar[2] + scan.angle_min + np.arange(len(ranges)) * scan.angle_increment
    some = slice(None, None, max(1, len(ranges) // beams))
    ranges, angles = ranges[some], angles[some]
    hit = np.isfinite(ranges) & (ranges >= scan.range_min)  # inf, -inf and nan tell no place
    ranges, angles = ranges[hit], angles[hit]
    return np.column_stack([lidar[0] + ranges * np.cos(angles), lidar[1] + ranges * np.sin(angles)])


def main(args=None):
    """Run the localization until Ctrl-C or SIGTERM."""
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Localizer()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
