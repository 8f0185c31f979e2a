"""Carts with a pole for the lesson, and a robot on a slope."""

from dataclasses import replace

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Float64

from sim import World


def cart(**figures):
    """The world `cart_pole` with other figures, such as `pole_length=0.5`; a push is (s, N)."""
    world = World.load("cart_pole").to_data()
    pushes = [{"begin": begin, "force": force} for begin, force in figures.pop("pushes", [])]
    world["cart_pole"] |= {**figures, "pushes": pushes}
    return World.from_data(world)


def outcome_of(recording):
    """How wide the pole swung; or when it fell."""
    states = recording.messages("/joint_states")
    angles = [(state.stamp, abs(state.message.position[1])) for state in states]
    fell = next((stamp for stamp, angle in angles if angle > 0.5), None)
    if fell is not None:
        return f"falls at {fell:.2f} s"
    return f"widest angle {max((angle for _, angle in angles), default=0.0):.2f} rad"


class Slope(Node):
    """Subscribes to /speed (Float64, m/s), and drives a robot up a slope, which takes away 8 cm/s."""

    def __init__(self):
        super().__init__("slope")
        self.speed = 0.0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Float64, "/speed", self.on_message, 10)
        self.create_timer(0.05, self.drive)

    def on_message(self, msg):
        """Remember the speed; the motors give 0.3 m/s at most."""
        self.speed = max(-0.3, min(0.3, msg.data))

    def drive(self):
        """Drive, and roll back."""
        command = Twist()
        command.linear.x = self.speed - 0.08
        self.publisher.publish(command)


HALL = World(  # its lidar is noisy
    name="hall",
    card="Picture: A hall with a wall ahead.",
    bounds=(-1.5, -1.0, 3.0, 1.0),
    walls=(((3.0, -1.0), (3.0, 1.0)), ((-1.5, -1.0), (-1.5, 1.0))),
    lidar=replace(World.load("room").lidar, noise=0.03),
)
