"""Emergency stops: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger


class Stop(Node):
    """As one would write it; the wrong ones change one thing each."""

    patience = 0.5  # s

    def __init__(self):
        super().__init__("stop")
        self.pressed, self.stopped, self.received = False, False, self.now()
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Twist, "/cmd_vel_raw", self.drive, 10)
        self.create_subscription(Bool, "/emergency", self.press, 10)
        self.create_service(Trigger, "/reset", self.reset)
        self.create_timer(0.1, self.watch)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def drive(self, msg):
        self.commands.publish(Twist() if self.stopped else msg)

    def press(self, msg):
        self.pressed, self.received = msg.data, self.now()
        if self.pressed:
            self.stop()

    def watch(self):
        if self.is_silent():
            self.stop()

    def stop(self):
        self.stopped = True
        self.commands.publish(Twist())

    def is_silent(self):
        return self.now() - self.received > self.patience

    def reset(self, request, response):
        response.success = not self.pressed and not self.is_silent()
        if response.success:
            self.stopped = False
        return response


class SaysNothingWhileStopped(Stop):
    """The robot stops by itself, too, after one zero."""

    def drive(self, msg):
        if not self.stopped:
            self.commands.publish(msg)


class RepeatsByATimer(Stop):
    """Sends the last command again and again; a stop forgets it."""

    def __init__(self):
        super().__init__()
        self.last = Twist()
        self.create_timer(0.05, lambda: self.commands.publish(self.last))

    def drive(self, msg):
        self.last = Twist() if self.stopped else msg
        self.commands.publish(self.last)

    def stop(self):
        self.last = Twist()
        super().stop()


class ReleasedUntil(Stop):
    """A design of its own: each False of the button holds for so long; a reset needs one that still holds."""

    def __init__(self):
        super().__init__()
        self.released_until = self.now() + self.patience

    def press(self, msg):
        self.released_until = 0.0 if msg.data else self.now() + self.patience
        if msg.data:
            self.stop()

    def watch(self):
        if self.now() > self.released_until:
            self.stop()

    def reset(self, request, response):
        response.success = self.now() < self.released_until
        self.stopped = self.stopped and not response.success
        return response


def main():
    rclpy.init()
    node = Stop()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


class DrivesBetween(Stop):
    """Each command passes, and then one of its own."""

    def drive(self, msg):
        super().drive(msg)
        timer = self.create_timer(0.02, lambda: (timer.cancel(), self.push()))

    def push(self):
        if not self.stopped:
            self.commands.publish(Twist(linear=Vector3(x=1.0)))


class CountsTheResets(Stop):
    """The second one is granted, whatever the button says."""

    asked = 0

    def reset(self, request, response):
        self.asked += 1
        self.pressed = self.asked < 2
        return super().reset(request, response)


class LetsGoByItself(Stop):
    """Stopped is what the button says now."""

    def press(self, msg):
        super().press(msg)
        self.stopped = msg.data


class OldSpeedComesBack(RepeatsByATimer):
    """The last command is kept while stopped, and sent again after the reset."""

    def drive(self, msg):
        self.last = msg
        self.publish()

    def stop(self):
        Stop.stop(self)

    def publish(self):
        self.commands.publish(Twist() if self.stopped else self.last)

    def __init__(self):
        Stop.__init__(self)
        self.last = Twist()
        self.create_timer(0.05, self.publish)


class AlwaysResets(Stop):
    """Says yes with the button in; the next word of the button stops it again."""

    def reset(self, request, response):
        self.stopped = False
        response.success = True
        return response


class NeverResets(Stop):
    """Asks for the wrong thing."""

    def reset(self, request, response):
        response.success = not self.stopped
        return response


class ResetsWithABrokenCable(Stop):
    """Counts a silent button as pressed in the timer alone, and releases until it checks again."""

    def is_silent(self):
        return False

    def watch(self):
        if Stop.is_silent(self):
            self.stop()


class ForgetsTheBrokenCable(ResetsWithABrokenCable):
    """Notices once that the button is silent; after a reset it drives on."""

    noticed = False

    def watch(self):
        if Stop.is_silent(self) and not self.noticed:
            self.noticed = True
            self.stop()


class SaysNoAndDoes(Stop):
    """Lets go, and forgets to say so."""

    def reset(self, request, response):
        self.stopped = self.pressed
        return response


class OnlyLogs(Stop):
    """A stop that stops nothing."""

    def stop(self):
        self.get_logger().error("Stop!")


class TrustsSilence(Stop):
    """No timer looks at the button."""

    def watch(self):
        pass


class SilentWithACutCable(SaysNothingWhileStopped):
    """Stops passing commands on, and leaves the stop to the robot."""

    def watch(self):
        self.stopped |= self.is_silent()


class LetsGoWithTheCable(Stop):
    """Counts silence, but only as long as it lasts."""

    silent = False

    def drive(self, msg):
        self.commands.publish(Twist() if self.stopped or self.silent else msg)

    def watch(self):
        self.silent = self.now() - self.received > self.patience


class NeverDrives(Stop):
    """Begins stopped."""

    def __init__(self):
        super().__init__()
        self.stopped = True


class NoService(Stop):
    """The service has another name."""

    def create_service(self, type_, name, callback, **more):
        other = "/release" if name == "/reset" else name
        return super().create_service(type_, other, callback, **more)


class RefusesAndLetsGo(Stop):
    """Refuses a reset while the button is in, and releases all the same, until the button's next message."""

    def reset(self, request, response):
        response.success = not self.pressed and not self.is_silent()
        self.stopped = False
        return response
