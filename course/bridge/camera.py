"""A camera for the simulated robot: walls as the lidar measures them, and a red post."""

import math

import numpy as np
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image, LaserScan

POST, THICK = (1.8, -0.5), 0.08  # m: where the post is, seen from the start of the robot, and its radius
WIDTH, HEIGHT, VIEW = 160, 120, math.radians(60)
SKY, FLOOR, WALL, RED = (205, 215, 225), (120, 120, 115), (175, 165, 150), (200, 30, 30)


class Camera(Node):
    """Publishes what is ahead of the robot on /image, ten times a second."""

    def __init__(self) -> None:
        super().__init__("camera")
        self.pose, self.scan = (0.0, 0.0, 0.0), None
        self.images = self.create_publisher(Image, "/image", qos_profile_sensor_data)
        self.create_subscription(Odometry, "/odom", self.move, qos_profile_sensor_data)
        self.create_subscription(LaserScan, "/scan", self.look, qos_profile_sensor_data)
        self.create_timer(0.1, self.take)

    def move(self, odometry: Odometry) -> None:
        """Remember where the robot is."""
        pose = odometry.pose.pose
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        self.pose = pose.position.x, pose.position.y, yaw

    def look(self, scan: LaserScan) -> None:
        """Remember the distances."""
        self.scan = scan

    def take(self) -> None:
        """Publish a picture."""
        if self.scan is None:
            return
        pixels = picture(self.pose, self.scan)
        image = Image(height=HEIGHT, width=WIDTH, encoding="rgb8", step=3 * WIDTH, data=pixels.tobytes())
        image.header.stamp, image.header.frame_id = self.scan.header.stamp, "camera_optical_frame"
        self.images.publish(image)


def picture(pose: tuple[float, float, float], scan: LaserScan) -> np.ndarray:
    """The picture as an array of height, width and the colors red, green, blue."""
    pixels = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    pixels[: HEIGHT // 2], pixels[HEIGHT // 2 :] = SKY, FLOOR
    for column in range(WIDTH):
        # To the left of straight ahead. An image is flat: the tangent grows evenly.
        angle = math.atan((1 - 2 * (column + 0.5) / WIDTH) * math.tan(VIEW / 2))
        ray = round((angle - scan.angle_min) / scan.angle_increment) % len(scan.ranges)
        distance = scan.ranges[ray] if math.isfinite(scan.ranges[ray]) else scan.range_max
        _draw(pixels, column, distance * math.cos(angle), WALL)
        post = _distance_to_post(pose, angle)
        if post < distance:
            _draw(pixels, column, post * math.cos(angle), RED)
    return pixels


def _draw(pixels: np.ndarray, column: int, depth: float, color: tuple[int, int, int]) -> None:
    """Draw something 0.4 m high at this depth (m), darker if it is farther away."""
    half = min(HEIGHT // 2, round(0.2 / max(depth, 0.05) * WIDTH / (2 * math.tan(VIEW / 2))))
    shade = 1.0 - 0.12 * min(depth, 4.0)
    pixels[HEIGHT // 2 - half : HEIGHT // 2 + half, column] = [round(shade * part) for part in color]


def _distance_to_post(pose: tuple[float, float, float], angle: float) -> float:
    """Along a ray from the robot (m); inf where it passes the post."""
    x, y, yaw = pose
    east, north = POST[0] - x, POST[1] - y
    along = east * math.cos(yaw + angle) + north * math.sin(yaw + angle)
    beside = -east * math.sin(yaw + angle) + north * math.cos(yaw + angle)
    if along <= 0 or abs(beside) > THICK:
        return math.inf
    return along - math.sqrt(THICK**2 - beside**2)
