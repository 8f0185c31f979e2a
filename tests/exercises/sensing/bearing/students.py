"""Nodes that find a red post in images: right ones, and wrong ones named by their defect."""

import array
import colorsys
import math

import numpy as np
import rclpy
from geometry_msgs.msg import PointStamped, Vector3Stamped
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from sensor_msgs.msg import Image
from std_msgs.msg import Header


class Finder(Node):
    """As one would write it; the others change one thing each."""

    qos, type, topic = qos_profile_sensor_data, Vector3Stamped, "/bearing"
    least = 20

    def __init__(self):
        super().__init__("finder")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_subscription(Image, "/image", self.see, self.qos)

    def see(self, image):
        pixels = self.pixels_of(image)
        columns = np.nonzero(self.is_red(*(pixels[..., channel] for channel in range(3))))[1]
        self.answer(image, columns)

    def answer(self, image, columns):
        if len(columns) >= self.least:
            self.publish(image.header, self.bearing(self.middle(columns), image.width))

    def pixels_of(self, image):
        rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
        pixels = rows[:, : 3 * image.width].reshape(image.height, image.width, 3)
        return pixels[..., ::-1] if image.encoding == "bgr8" else pixels

    def is_red(self, red, green, blue):
        red, green, blue = red.astype(int), green.astype(int), blue.astype(int)
        return (red > 90) & (2 * green < red) & (2 * blue < red)

    def middle(self, columns):
        return np.median(columns) + 0.5

    def bearing(self, column, width):
        return math.atan(1 - 2 * column / width)

    def publish(self, header, bearing):
        answer = self.type(header=self.header(header))
        answer.vector.z = float(bearing)
        self.publisher.publish(answer)

    def header(self, of_image):
        return Header(stamp=of_image.stamp, frame_id="camera_link")


class HalvesInstead(Finder):
    """red // 2 can't wrap. The column is counted from the middle, with a focal length in pixels."""

    def is_red(self, red, green, blue):
        return (red > 90) & (green < red // 2) & (blue < red // 2)

    def bearing(self, column, width):
        focal_length = (width / 2) / math.tan(math.radians(45))
        return -math.atan2(column - width / 2, focal_length)


class CountsPerColumn(Finder):
    """A design of its own: the columns with many red pixels, from the first one to the last one."""

    def answer(self, image, columns):
        counts = np.bincount(columns, minlength=image.width)
        full = np.flatnonzero(counts >= 11)
        if len(full):
            self.publish(image.header, self.bearing((full[0] + full[-1] + 1) / 2, image.width))


class LargestGroup(Finder):
    """Red pixels without a red neighbor are left out; the mean of the others is the middle."""

    def is_red(self, *channels):
        red = np.pad(super().is_red(*channels), 1)
        beside = red[1:-1, :-2].astype(int) + red[1:-1, 2:] + red[:-2, 1:-1] + red[2:, 1:-1]
        return red[1:-1, 1:-1] & (beside >= 2)

    def middle(self, columns):
        return columns.mean() + 0.5


class OnATimer(Finder):
    """Remembers the newest image, and looks at it in a timer."""

    qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    image = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.05, self.work)

    def see(self, image):
        self.image = image

    def work(self):
        if self.image is not None:
            image, self.image = self.image, None
            super().see(image)


def by_hand():
    """Without NumPy: the hue of each pixel, and the middle one of the sorted columns."""
    rclpy.init()
    node = rclpy.create_node("by_hand")
    publisher = node.create_publisher(Vector3Stamped, "bearing", 1)

    def is_red(red, green, blue):
        hue, saturation, value = colorsys.rgb_to_hsv(red / 255, green / 255, blue / 255)
        return min(hue, 1 - hue) < 0.05 and saturation > 0.5 and value > 0.35

    def callback(image: Image):
        data, columns = array.array("B", image.data), []
        for row in range(image.height):
            for column in range(image.width):
                start = row * image.step + 3 * column
                values = data[start : start + 3]
                if is_red(*(reversed(values) if image.encoding.startswith("bgr") else values)):
                    columns.append(column)
        if len(columns) > 15:
            answer = Vector3Stamped()
            answer.header.stamp, answer.header.frame_id = image.header.stamp, "camera_link"
            middle = sorted(columns)[len(columns) // 2] + 0.5
            answer.vector.z = math.atan2(image.width / 2 - middle, image.width / 2)
            publisher.publish(answer)

    node.create_subscription(Image, "image", callback, qos_profile_sensor_data)
    rclpy.spin(node)


class RightIsPositive(Finder):
    def bearing(self, column, width):
        return -super().bearing(column, width)


class InDegrees(Finder):
    def bearing(self, column, width):
        return math.degrees(super().bearing(column, width))


class PixelsAreAngles(Finder):
    """Right in the middle and at the edges, and wrong in between."""

    def bearing(self, column, width):
        return math.radians(90) * (0.5 - column / width)


class TangentOnly(Finder):
    def bearing(self, column, width):
        return 1 - 2 * column / width


class AlwaysInfinite(Finder):
    def bearing(self, column, width):
        return math.inf


class MeanOfAll(Finder):
    """Single pixels far away move the mean."""

    def middle(self, columns):
        return columns.mean() + 0.5


class TallestColumn(Finder):
    """The column with the most red pixels."""

    def middle(self, columns):
        return np.bincount(columns).argmax() + 0.5


class Overflows(Finder):
    """2 * 150 is 44 in uint8."""

    def is_red(self, red, green, blue):
        return (red > 90) & (2 * green < red) & (2 * blue < red)


class BrightIsRed(Finder):
    def is_red(self, red, green, blue):
        return red > 150


class SomeRedIsEnough(Finder):
    def is_red(self, red, green, blue):
        return red > 90


class LooksForGreen(Finder):
    def is_red(self, red, green, blue):
        return (green > 90) & (2 * red.astype(int) < green)


class ForgetsBlue(Finder):
    """Magenta counts as red."""

    def is_red(self, red, green, blue):
        return (red > 90) & (2 * green.astype(int) < red)


class RepeatsTheLast(Finder):
    """A timer repeats the last bearing."""

    last = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.05, self.repeat)

    def publish(self, header, bearing):
        self.last = header, bearing

    def repeat(self):
        if self.last is not None:
            super().publish(*self.last)


class WidthOfOneCamera(Finder):
    """It has seen images with 640 columns only."""

    def bearing(self, column, width):
        return super().bearing(column, 640)


class SeesTheLeftOnly(Finder):
    """Most posts get no message."""

    def publish(self, header, bearing):
        if bearing > 0.5:
            super().publish(header, bearing)


class OnePixelIsEnough(Finder):
    least = 1


class NanWithoutAPost(Finder):
    """nan may be clear to a person; a program compares with it, and gets False."""

    def answer(self, image, columns):
        found = len(columns) >= self.least
        self.publish(image.header, self.bearing(self.middle(columns), image.width) if found else math.nan)


class ZeroWithoutAPost(Finder):
    """As if the post were straight ahead."""

    def answer(self, image, columns):
        found = len(columns) >= self.least
        self.publish(image.header, self.bearing(self.middle(columns), image.width) if found else 0.0)


class TimeOfTheAnswer(Finder):
    def publish(self, header, bearing):
        header.stamp = self.get_clock().now().to_msg()
        super().publish(header, bearing)


class NoHeader(Finder):
    def publish(self, header, bearing):
        answer = self.type()
        answer.vector.z = float(bearing)
        self.publisher.publish(answer)


class CopiesTheFrame(Finder):
    """The image's frame is the optical one."""

    def header(self, of_image):
        return of_image


class FrameOfItsOwn(Finder):
    def header(self, of_image):
        return Header(stamp=of_image.stamp, frame_id="finder")


class ReshapesByWidth(Finder):
    """A ValueError, if rows have padding."""

    def pixels_of(self, image):
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3)
        return pixels[..., ::-1] if image.encoding == "bgr8" else pixels


class PaddingIsPixels(Finder):
    """It reshapes by step, and cuts nothing off."""

    def pixels_of(self, image):
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step // 3, 3)
        return pixels[..., ::-1] if image.encoding == "bgr8" else pixels


class FirstBytes(Finder):
    """Each row begins a little later than it thinks."""

    def pixels_of(self, image):
        size = 3 * image.height * image.width
        pixels = np.frombuffer(image.data, np.uint8)[:size].reshape(image.height, image.width, 3)
        return pixels[..., ::-1] if image.encoding == "bgr8" else pixels


class AlwaysRgb(Finder):
    """Blue posts are red ones."""

    def pixels_of(self, image):
        rows = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
        return rows[:, : 3 * image.width].reshape(image.height, image.width, 3)


class Reliable(Finder):
    """The camera offers best effort: nothing arrives, and there is no error."""

    qos = 10


class OtherType(Finder):
    type = PointStamped

    def publish(self, header, bearing):
        answer = PointStamped(header=self.header(header))
        answer.point.z = bearing
        self.publisher.publish(answer)


class OtherTopic(Finder):
    topic = "/post"
