"""Velocity muxes: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.node import Node


class Mux(Node):
    """As one would write it; the wrong ones change one thing each."""

    topics = ("/cmd_vel_joy", "/cmd_vel_nav")  # the one that counts more first
    patience = 0.5  # s

    def __init__(self):
        super().__init__("mux")
        self.received = {}
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        for topic in self.topics:
            self.create_subscription(Twist, topic, lambda msg, topic=topic: self.on_message(topic, msg), 10)
        self.create_timer(0.05, self.choose)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def on_message(self, topic, msg):
        self.received[topic] = self.now(), msg

    def is_young(self, topic):
        return topic in self.received and self.now() - self.received[topic][0] < self.patience

    def choose(self):
        for topic in self.topics:
            if self.is_young(topic):
                self.commands.publish(self.received[topic][1])
                return
        self.commands.publish(Twist())


class PassesOn(Mux):
    """A design of its own: passes on what no higher priority has blocked lately; its timer only stops."""

    def on_message(self, topic, msg):
        super().on_message(topic, msg)
        if topic == self.topics[0] or not self.is_young(self.topics[0]):
            self.commands.publish(msg)

    def choose(self):
        if not any(map(self.is_young, self.topics)):
            self.commands.publish(Twist())


class SilentWhenBothAre(PassesOn):
    """Trusts the robot to stop by itself."""

    def choose(self):
        pass


class CountsTicks(Mux):
    """The age in ticks of the timer."""

    def now(self):
        return self.ticks * 0.05

    ticks = 0

    def choose(self):
        self.ticks += 1
        super().choose()


def main():
    rclpy.init()
    rclpy.spin(Mux())


class RightOnceIn100Milliseconds(Mux):
    """And drives as it likes for the rest of the time."""

    ticks = 0

    def __init__(self):
        super().__init__()
        self.create_timer(0.01, self.tick)

    def choose(self):
        pass

    def tick(self):
        self.ticks += 1
        if self.ticks % 10 == 6:
            super().choose()
        elif self.ticks % 10 == 8 and any(map(self.is_young, self.topics)):
            self.commands.publish(Twist(linear=Vector3(x=0.5)))


class NeverTimesOut(Mux):
    """What someone said holds forever."""

    def is_young(self, topic):
        return topic in self.received


class OnlyTheJoystickTimesOut(Mux):
    """The navigator's last command is sent forever."""

    def is_young(self, topic):
        return topic in self.received and (topic == self.topics[1] or super().is_young(topic))


class OldCommandComesBack(Mux):
    """Looks who has spoken lately at all, and sends the navigator's command from before."""

    def choose(self):
        joy, nav = self.topics
        if self.is_young(joy):
            self.commands.publish(self.received[joy][1])
        elif nav in self.received and self.now() - max(said for said, _ in self.received.values()) < 3.0:
            self.commands.publish(self.received[nav][1])
        else:
            self.commands.publish(Twist())


class NavigatorFirst(Mux):
    """The other way round."""

    topics = ("/cmd_vel_nav", "/cmd_vel_joy")


class WhoSpokeLast(Mux):
    """Both get through, in turn."""

    def choose(self):
        young = [topic for topic in self.topics if self.is_young(topic)]
        topic = max(young, key=lambda topic: self.received[topic][0], default=None)
        self.commands.publish(self.received[topic][1] if topic else Twist())


class PassesAll(Mux):
    """No choice at all."""

    def on_message(self, topic, msg):
        self.commands.publish(msg)

    def choose(self):
        pass


class ZeroIsNothing(Mux):
    """A joystick that says 0 counts as one that says nothing."""

    def on_message(self, topic, msg):
        if topic != self.topics[0] or msg != Twist():
            super().on_message(topic, msg)


class HoldsTheJoystickLong(Mux):
    """3 s in place of 0.5 s."""

    patience = 3.0


class HasNoPatience(Mux):
    """Twice the time between two commands: but over a network one comes late now and then."""

    patience = 0.2


class AddsBoth(Mux):
    """The sum of what both want."""

    def choose(self):
        msg = Twist()
        for topic in filter(self.is_young, self.topics):
            msg.linear.x += self.received[topic][1].linear.x
            msg.angular.z += self.received[topic][1].angular.z
        self.commands.publish(msg)


class OneDriver(Mux):
    """Knows the joystick only."""

    topics = ("/cmd_vel_joy",)
