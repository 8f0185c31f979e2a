"""Odometry with a covariance: right ones, and wrong ones named after their defect."""

import math

import numpy as np
import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty

RADIUS, TRACK, SLIP = 0.033, 0.16, 0.007


class WheelOdometry(Node):
    """The textbook's: P = F P F' + B Q B', with the heading in the middle of the step."""

    topic, child = "/wheel_odom", "base_link"

    def __init__(self):
        super().__init__("wheel_odometry")
        self.before = None
        self.reset()
        self.publisher = self.create_publisher(Odometry, self.topic, 10)
        self.create_subscription(Empty, "/reset_odometry", lambda msg: self.reset(), 10)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)

    def reset(self):
        self.x = self.y = self.yaw = 0.0
        self.P = np.zeros((3, 3))

    def on_joints(self, msg):
        now = [RADIUS * angle for angle in msg.position]
        left, right = np.subtract(now, self.before or now)
        self.before = now
        self.move(left, right)
        self.publish(msg.header.stamp)

    def move(self, left, right):
        d, turn = (left + right) / 2, (right - left) / TRACK
        middle = self.yaw + turn / 2
        self.grow(d, middle, left, right)
        self.x += d * math.cos(middle)
        self.y += d * math.sin(middle)
        self.yaw += turn

    def grow(self, d, yaw, left, right):
        F = self.jacobian(d, yaw)
        self.P = F @ self.P @ F.T + self.noise(d, yaw, left, right)

    def jacobian(self, d, yaw):
        return np.array([[1.0, 0.0, -d * math.sin(yaw)], [0.0, 1.0, d * math.cos(yaw)], [0.0, 0.0, 1.0]])

    def noise(self, d, yaw, left, right):
        c, s = math.cos(yaw) / 2, math.sin(yaw) / 2
        B = np.array([[c, c], [s, s], [-1 / TRACK, 1 / TRACK]])
        B += d / TRACK * np.array([[s, -s], [-c, c], [0.0, 0.0]])
        return B @ np.diag(self.variances(left, right)) @ B.T

    def variances(self, left, right):
        return SLIP**2 * abs(left), SLIP**2 * abs(right)

    def publish(self, stamp):
        odom = Odometry(child_frame_id=self.child)
        odom.header.frame_id, odom.header.stamp = "odom", stamp
        odom.pose.pose.position.x, odom.pose.pose.position.y = float(self.x), float(self.y)
        odom.pose.pose.orientation.z = math.sin(self.yaw / 2)
        odom.pose.pose.orientation.w = math.cos(self.yaw / 2)
        self.fill(odom.pose.covariance, self.P)
        self.publisher.publish(odom)

    def fill(self, numbers, P):
        for i, row in enumerate((0, 1, 5)):
            for j, column in enumerate((0, 1, 5)):
                numbers[6 * row + column] = float(P[i, j])


class FromTheStartOfTheStep(WheelOdometry):
    """Without the half turn in the derivatives: steps are short."""

    def noise(self, d, yaw, left, right):
        c, s = math.cos(yaw) / 2, math.sin(yaw) / 2
        B = np.array([[c, c], [s, s], [-1 / TRACK, 1 / TRACK]])
        return SLIP**2 * (B * np.abs([left, right])) @ B.T


class DistanceAndTurn(WheelOdometry):
    """Noise of distance and turn, as AMCL and most textbooks have it, and how the two go together."""

    def noise(self, d, yaw, left, right):
        a, b = self.variances(left, right)
        along, both, turn = (a + b) / 4, (b - a) / (2 * TRACK), (a + b) / TRACK**2
        ahead = np.array([math.cos(yaw), math.sin(yaw), 0.0])
        up = np.array([0.0, 0.0, 1.0])
        mixed = both * (np.outer(ahead, up) + np.outer(up, ahead))
        return along * np.outer(ahead, ahead) + mixed + turn * np.outer(up, up)


class FarAxes(WheelOdometry):
    """Doesn't know z, roll and pitch: large variances for them, as drivers of real robots publish."""

    def fill(self, numbers, P):
        super().fill(numbers, P)
        numbers[14] = numbers[21] = numbers[28] = 1e6


class Numbers(WheelOdometry):
    """Six numbers and no matrix."""

    def reset(self):
        super().reset()
        self.xx = self.xy = self.xt = self.yy = self.yt = self.tt = 0.0

    def grow(self, d, yaw, left, right):
        a, b = -d * math.sin(yaw), d * math.cos(yaw)
        self.xx += 2 * a * self.xt + a * a * self.tt
        self.xy += a * self.yt + b * self.xt + a * b * self.tt
        self.yy += 2 * b * self.yt + b * b * self.tt
        self.xt += a * self.tt
        self.yt += b * self.tt
        c, s = math.cos(yaw) / 2, math.sin(yaw) / 2
        for rolled, side in ((left, -1 / TRACK), (right, 1 / TRACK)):
            q = SLIP**2 * abs(rolled)
            self.xx, self.xy, self.yy = self.xx + q * c * c, self.xy + q * c * s, self.yy + q * s * s
            self.xt, self.yt, self.tt = self.xt + q * c * side, self.yt + q * s * side, self.tt + q * side**2
        self.P = np.array(
            [[self.xx, self.xy, self.xt], [self.xy, self.yy, self.yt], [self.xt, self.yt, self.tt]]
        )


class Cloud(WheelOdometry):
    """A design of its own: 2000 robots that slip differently, and the covariance of where they are."""

    def __init__(self):
        self.rng = np.random.default_rng(7)
        super().__init__()

    def reset(self):
        super().reset()
        self.cloud = np.zeros((3, 2000))

    def grow(self, d, yaw, left, right):
        wheels = np.array([[left], [right]])
        noise = self.rng.standard_normal((2, self.cloud.shape[1]))
        lefts, rights = wheels + SLIP * np.sqrt(np.abs(wheels)) * noise
        turns, ds = (rights - lefts) / TRACK, (lefts + rights) / 2
        middles = self.cloud[2] + turns / 2
        self.cloud += np.array([ds * np.cos(middles), ds * np.sin(middles), turns])
        self.P = np.cov(self.cloud)


class InTheBody(WheelOdometry):
    """A design of its own: the covariance in the robot's own axes, turned into odom's to publish."""

    def grow(self, d, yaw, left, right):
        turn = (right - left) / TRACK
        c, s = math.cos(turn), math.sin(turn)
        # What the robot sees of its old error after a step: its axes have turned, and are further on.
        move = np.array([[c, s, d * math.sin(turn / 2)], [-s, c, d * math.cos(turn / 2)], [0.0, 0.0, 1.0]])
        h, g = math.cos(turn / 2) / 2, -math.sin(turn / 2) / 2
        B = np.array([[h, h], [g, g], [-1 / TRACK, 1 / TRACK]])
        self.P = move @ self.P @ move.T + B @ np.diag(self.variances(left, right)) @ B.T

    def fill(self, numbers, P):
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        super().fill(numbers, turned @ P @ turned.T)


class Unscented(WheelOdometry):
    """A design of its own: seven poses through the motion, no derivative."""

    def grow(self, d, yaw, left, right):
        start = np.array([self.x, self.y, self.yaw, left, right])
        P = np.zeros((5, 5))
        P[:3, :3] = self.P
        P[3, 3], P[4, 4] = self.variances(left, right)
        root = np.linalg.cholesky(5 * P + 1e-18 * np.eye(5))
        points = np.array([self.moved(start + sign * column) for column in root.T for sign in (1, -1)])
        off = points - points.mean(axis=0)
        self.P = off.T @ off / 10

    def moved(self, state):
        x, y, yaw, left, right = state
        d, turn = (left + right) / 2, (right - left) / TRACK
        middle = yaw + turn / 2
        return x + d * math.cos(middle), y + d * math.sin(middle), yaw + turn


def main():
    """A program without a class, with the arrays as columns."""
    rclpy.init()
    node = rclpy.create_node("wheel_odometry")
    pub = node.create_publisher(Odometry, "wheel_odom", 10)
    state = {"pose": np.zeros(3), "P": np.zeros((3, 3)), "last": None}

    def start_again(_):
        state.update(pose=np.zeros(3), P=np.zeros((3, 3)))

    def on_joints(msg):
        sides = dict(zip(msg.name, msg.position, strict=True))
        now = RADIUS * np.array([sides["wheel_left_joint"], sides["wheel_right_joint"]])
        moved = now - (now if state["last"] is None else state["last"])
        yaw = state["pose"][2] + (moved[1] - moved[0]) / TRACK / 2
        heading = np.array([np.cos(yaw), np.sin(yaw)])
        G = np.vstack([np.outer(heading, [0.5, 0.5]), [[-1 / TRACK, 1 / TRACK]]])
        step = G @ moved
        F = np.eye(3)
        F[:2, 2] = -step[1], step[0]
        state["P"] = F @ state["P"] @ F.T + G * SLIP**2 * np.abs(moved) @ G.T
        state["pose"], state["last"] = state["pose"] + step, now
        odom = Odometry(header=msg.header, child_frame_id="base_link")
        odom.header.frame_id = "odom"
        odom.pose.pose.position.x, odom.pose.pose.position.y = state["pose"][:2].tolist()
        half = state["pose"][2] / 2
        odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = float(np.sin(half)), float(np.cos(half))
        whole = np.zeros((6, 6))
        whole[np.ix_([0, 1, 5], [0, 1, 5])] = state["P"]
        odom.pose.covariance = whole.ravel()
        pub.publish(odom)

    node.create_subscription(Empty, "reset_odometry", start_again, 10)
    node.create_subscription(JointState, "joint_states", on_joints, 10)
    rclpy.spin(node)


class Zeros(WheelOdometry):
    """As most drivers do."""

    def fill(self, numbers, P):
        pass


class YawAtSeven(WheelOdometry):
    """As if the message had three rows."""

    def fill(self, numbers, P):
        numbers[0], numbers[4], numbers[7] = P[0, 0], P[1, 1], P[2, 2]


class DiagonalOnly(WheelOdometry):
    """Honest on each axis, and silent about how they go together."""

    def fill(self, numbers, P):
        numbers[0], numbers[7], numbers[35] = P[0, 0], P[1, 1], P[2, 2]


class GrowsWithEachMessage(WheelOdometry):
    def noise(self, d, yaw, left, right):
        return super().noise(d, yaw, left, right) + np.diag([1e-6, 1e-6, 1e-5])


class GrowsWithTime(WheelOdometry):
    """As if it always drove with 0.4 m/s, once it has set off."""

    def variances(self, left, right):
        has_set_off = left or right or self.P.any()
        return (SLIP**2 * 0.04 if has_set_off else 0.0,) * 2


class Degrees(WheelOdometry):
    def fill(self, numbers, P):
        scale = np.diag([1.0, 1.0, math.degrees(1.0)])
        super().fill(numbers, scale @ P @ scale)


class HugeForever(WheelOdometry):
    def fill(self, numbers, P):
        super().fill(numbers, np.eye(3) * 1000.0)


class TheSameForever(WheelOdometry):
    """Right for a drive of mean length."""

    def fill(self, numbers, P):
        super().fill(numbers, np.diag([0.0013, 0.0024, 0.0063]))


class StandardDeviations(WheelOdometry):
    def fill(self, numbers, P):
        super().fill(numbers, np.diag(np.sqrt(np.diag(P))))


class NoJacobian(WheelOdometry):
    """Adds the noise of each step, and forgets what a wrong yaw does to x and y."""

    def jacobian(self, d, yaw):
        return np.eye(3)


class InTheRobotsAxes(WheelOdometry):
    """Publishes the covariance of what is ahead and what is to the left."""

    def fill(self, numbers, P):
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        turn = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        super().fill(numbers, turn @ P @ turn.T)


class SignedDistance(WheelOdometry):
    """Becomes more certain when it rolls backwards."""

    def variances(self, left, right):
        return SLIP**2 * left, SLIP**2 * right


class LinearWithDistance(WheelOdometry):
    """Standard deviations that add up: they don't, variances do."""

    rolled = 0.0

    def variances(self, left, right):
        return SLIP**2 * 6 * abs(left), SLIP**2 * 6 * abs(right)


class SquaresOfSteps(WheelOdometry):
    """The variance of a step as the square of a fraction of it: far too small for short steps."""

    def variances(self, left, right):
        return (SLIP * left) ** 2, (SLIP * right) ** 2


class NeverResets(WheelOdometry):
    def reset(self):
        if self.before is None:
            super().reset()


class ForgetsToResetP(WheelOdometry):
    def reset(self):
        old = getattr(self, "P", np.zeros((3, 3)))
        super().reset()
        self.P = old


class NotANumber(WheelOdometry):
    """Divides by the distance, which is 0 at times."""

    def variances(self, left, right):
        return [SLIP**2 * np.float64(side) ** 2 / np.float64(abs(side)) for side in (left, right)]


class HalfAMatrix(WheelOdometry):
    """Only what is above the diagonal."""

    def fill(self, numbers, P):
        super().fill(numbers, np.triu(P))


class WrongFrames(WheelOdometry):
    child = "base_footprint"


class TheTimeOfNow(WheelOdometry):
    def publish(self, stamp):
        super().publish(rclpy.time.Time(nanoseconds=self.get_clock().now().nanoseconds + 10**7).to_msg())


class AnotherTopic(WheelOdometry):
    topic = "/odometry"
