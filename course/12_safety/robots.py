"""Others for the lesson: a robot that trusts everybody, drivers, a button, and a manager of lifecycles."""

from dataclasses import replace

from geometry_msgs.msg import Twist
from lifecycle_msgs.srv import ChangeState
from rclpy.node import Node
from std_msgs.msg import Bool, Float64
from std_srvs.srv import Trigger

from sim import World, since_start

YARD = World.load("yard")
TRUSTING = replace(YARD, robot=replace(YARD.robot, command_timeout=1000.0))  # obeys the last command forever
HALL = World(
    name="hall",
    card="Picture: A hall with a wall ahead.",
    bounds=(-1.0, -1.0, 3.0, 1.0),
    walls=(((3.0, -1.0), (3.0, 1.0)), ((-1.0, -1.0), (-1.0, 1.0))),
    lidar=replace(World.load("room").lidar, noise=0.02),
)


class Timed(Node):
    """Looks at the clock ten times a second."""

    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, lambda: self.tick(since_start(self.get_clock().now().to_msg())))


class Driver(Timed):
    """Says on /cmd_vel_raw that it wants 0.3 m/s; between 3 s and 6 s it says nothing."""

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel_raw", 10)

    def tick(self, now):
        """Drive, or be silent."""
        if not 3.0 < now < 6.0:
            command = Twist()
            command.linear.x = 0.3
            self.publisher.publish(command)


class Stubborn(Driver):
    """As Driver, and never silent."""

    def tick(self, now):
        """Drive."""
        super().tick(0.0)


class Sensors(Timed):
    """Publishes a speed and a distance at the same time."""

    def __init__(self):
        super().__init__("sensors")
        self.both = [self.create_publisher(Float64, topic, 10) for topic in ("/speed", "/distance")]

    def tick(self, now):
        """Publish both."""
        for publisher in self.both:
            publisher.publish(Float64(data=1.0))


class Button(Timed):
    """Is pressed (Bool on /emergency) from 2 s to 3 s; at 5 s /reset is called."""

    def __init__(self):
        super().__init__("button")
        self.publisher = self.create_publisher(Bool, "/emergency", 10)
        self.client = self.create_client(Trigger, "/reset")
        self.asked = False

    def tick(self, now):
        """Say whether it is pressed."""
        self.publisher.publish(Bool(data=2.0 <= now < 3.0))
        if now >= 5.0 and not self.asked and self.client.service_is_ready():
            self.asked = True
            self.client.call_async(Trigger.Request())


class Manager(Timed):
    """Leads the node /motor through its life: configure at 1 s, activate at 2 s, deactivate at 5 s."""

    last = "deactivate"

    def __init__(self):
        super().__init__("manager")
        self.client = self.create_client(ChangeState, "/motor/change_state")
        self.plan = [(5.0, self.last), (2.0, "activate"), (1.0, "configure")]

    def tick(self, now):
        """Ask for the transition that is due."""
        if self.plan and now >= self.plan[-1][0]:
            request = ChangeState.Request()
            request.transition.label = self.plan.pop()[1]
            self.client.call_async(request)


class Ending(Manager):
    """As Manager, but at 5 s it shuts the node down while it is active."""

    last = "shutdown"
