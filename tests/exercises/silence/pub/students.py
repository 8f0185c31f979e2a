"""Commands that drive the robot: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.exercises.silence import terminal

TYPE = "geometry_msgs/msg/Twist"
PARTS = ("_spins_a_node",)

Plain = terminal(f"ros2 topic pub --rate 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'")
InJson = terminal(
    f'ros2 topic pub cmd_vel {TYPE} \'{{"linear": {{"x": 0.3}}, "angular": {{"z": 0.6}}}}\' -r 5'
)
Whole = terminal(
    lambda: (
        f'ros2 topic pub -r 20 /cmd_vel {TYPE} "linear: {{x: 0.3, y: 0, z: 0}}\nangular: {{x: 0, z: 0.6}}"'
    )
)


Named = terminal(
    f"ros2 topic pub -r 4 -n circler /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'  # round"
)
OnceRound = terminal(  # a design of its own: exactly one round, and then it ends
    f"ros2 topic pub -r 10 -t 105 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'"
)

OnceASecond = terminal(f"ros2 topic pub /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'")
Once = terminal(f"ros2 topic pub --once /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'")
StopsEarly = terminal(
    f"ros2 topic pub -r 10 -t 50 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'"
)
MisspeltTopic = terminal(
    f"ros2 topic pub -r 10 /cmd_val {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'"
)
OtherType = terminal(
    "ros2 topic pub -r 10 /cmd_vel geometry_msgs/msg/TwistStamped '{twist: {linear: {x: 0.3}}}'"
)
ShortType = terminal("ros2 topic pub -r 10 /cmd_vel Twist '{linear: {x: 0.3}, angular: {z: 0.6}}'")
NoQuotes = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} {{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}")
NoSpaces = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear:{{x:0.3}}, angular:{{z:0.6}}}}'")
OpenQuote = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}")
WrongField = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{speed: 0.3, turn: 0.6}}'")
WrongVerb = terminal(f"ros2 topic send -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'")
NoRos2 = terminal(f"topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'")
NothingReturned = terminal(lambda: None)
Straight = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.6}}}}'")
WrongAxis = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.1}}, angular: {{x: 0.6}}}}'")
ToTheRight = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: -0.6}}}}'")
OnTheSpot = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{angular: {{z: 0.6}}}}'")
TooWide = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.3}}}}'")
TooFast = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.5}}, angular: {{z: 1.0}}}}'")
MuchTooWide = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.15}}}}'")
NearlyRound = terminal(
    f"ros2 topic pub -r 10 -t 90 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.6}}}}'"
)
Listens = terminal("ros2 topic echo /odom")
ABitTooWide = terminal(f"ros2 topic pub -r 10 /cmd_vel {TYPE} '{{linear: {{x: 0.3}}, angular: {{z: 0.4}}}}'")


class ANode(Node):
    """It does the same, but is no command."""

    def __init__(self):
        super().__init__("circler")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = 0.3, 0.6
        self.publisher.publish(command)


def _spins_a_node():
    rclpy.init()
    rclpy.spin(ANode())


ANodeInTheFunction = terminal(_spins_a_node)
