"""Nodes for a lift that gets stuck: right ones, and wrong ones named by their defect."""

import math
from xml.etree import ElementTree

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Careful(Node):
    """As one would write it; the wrong ones change one thing each."""

    patience = 0.5

    def __init__(self):
        super().__init__("careful")
        self.lower = self.upper = self.most = math.nan  # nothing is within these
        self.since, self.begin = None, self.get_clock().now()
        self.publisher = self.create_publisher(Float64, "/joint_commands", 10)
        self.create_subscription(String, "/robot_description", self.read, LATCHED)
        self.create_subscription(Float64, "/wanted", self.want, 10)
        self.create_subscription(JointState, "/joint_states", self.watch, 10)

    def read(self, msg):
        limit = ElementTree.fromstring(msg.data).find("joint[@name='lift_joint']/limit")
        self.lower, self.upper, self.most = (float(limit.get(key)) for key in ("lower", "upper", "effort"))

    def want(self, msg):
        if self.can_go_to(msg.data):
            self.publisher.publish(msg)
        else:
            self.refuse(msg.data)

    def can_go_to(self, position):
        return self.lower <= position <= self.upper

    def refuse(self, position):
        self.get_logger().warning(f"{position:.2f} rad is beyond the limits: refused")

    def index(self, msg):
        return msg.name.index("lift_joint")

    def watch(self, msg):
        index = self.index(msg)
        if not self.pulls(msg.effort[index], msg.velocity[index]):
            self.since = None
            return
        now = (self.get_clock().now() - self.begin).nanoseconds / 1e9
        if self.since is None:
            self.since = now
        if now - self.since >= self.patience:
            self.since = None
            self.free(msg.position[index])

    def pulls(self, effort, velocity):
        return abs(effort) >= self.most and abs(velocity) < 0.01

    def free(self, position):
        self.get_logger().error(f"Stuck at {position:.2f} rad")
        self.publisher.publish(Float64(data=position))


class CountsMessages(Careful):
    """A design of its own: ten states in a row; the stamp of a message isn't needed."""

    count = 0

    def watch(self, msg):
        states = dict(zip(msg.name, zip(msg.position, msg.velocity, msg.effort, strict=False), strict=False))
        position, velocity, effort = states["lift_joint"]
        self.count = self.count + 1 if self.pulls(effort, velocity) else 0
        if self.count == 12:
            self.free(position)


class WithExceptions(Careful):
    """A function that raises, and a callback that goes on."""

    def checked(self, position):
        if math.isnan(position):
            raise ValueError("no number")
        if position < self.lower or position > self.upper:
            raise ValueError(f"{position:.2f} rad is beyond {self.lower} to {self.upper} rad")
        return position

    def want(self, msg):
        try:
            self.publisher.publish(Float64(data=self.checked(msg.data)))
        except ValueError as error:
            self.get_logger().warning(f"Refused: {error}")


class PassesAll(Careful):
    def can_go_to(self, position):
        return True


class NanPassesThrough(Careful):
    def can_go_to(self, position):
        return not (position < self.lower or position > self.upper)


class UpperLimitOnly(Careful):
    def can_go_to(self, position):
        return abs(position) <= self.upper


class LimitsAreBeyond(Careful):
    """The limit itself can be gone to."""

    def can_go_to(self, position):
        return self.lower < position < self.upper


class ComparesWithZero(Careful):
    """The encoder measures 0.0 hardly ever."""

    def pulls(self, effort, velocity):
        return abs(effort) >= self.most and velocity == 0.0


class CutsToTheLimits(Careful):
    def want(self, msg):
        if not self.can_go_to(msg.data):
            self.refuse(msg.data)
        self.publisher.publish(Float64(data=max(self.lower, min(self.upper, msg.data))))


class SaysNothing(Careful):
    def refuse(self, position):
        pass


class Raises(Careful):
    """An error that no one catches ends the program."""

    def refuse(self, position):
        raise ValueError("beyond the limits")


class GivesUp(Careful):
    """After the first refusal it takes no request any more."""

    offended = False

    def can_go_to(self, position):
        self.offended = self.offended or not super().can_go_to(position)
        return not self.offended


class Degrees(Careful):
    """Requests are radians already."""

    def want(self, msg):
        self.publisher.publish(Float64(data=math.degrees(msg.data)))


class LimitsInDegrees(Careful):
    def can_go_to(self, position):
        return self.lower <= math.degrees(position) <= self.upper


class LetsItBurn(Careful):
    def free(self, position):
        pass


class FirstPeak(Careful):
    """Stuck, at the first state with high effort: so whenever it starts."""

    patience = 0.0


class TooPatient(Careful):
    patience = 1.5


class ByIndex(Careful):
    """The fan is first, and never stuck."""

    def index(self, msg):
        return 0


class GoesHome(Careful):
    def free(self, position):
        self.publisher.publish(Float64(data=0.0))


class SignOfTheEffort(Careful):
    """Notices it on the way up only."""

    def pulls(self, effort, velocity):
        return effort >= self.most and abs(velocity) < 0.01
