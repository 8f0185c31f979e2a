"""Programs that do one thing each with turtlesim, in the order of a list."""

from geometry_msgs.msg import Twist, Vector3
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Empty
from turtlesim.action import RotateAbsolute
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative


class Script(Node):
    """Does each of `steps`, (stamp in s, method, arguments), when it is due."""

    steps = ()

    def __init__(self):
        super().__init__("script")
        self.ends = {}
        for number, (stamp, method, *arguments) in enumerate(self.steps):
            self.create_timer(stamp, lambda n=number, m=method, a=arguments: self.do(n, m, a))
        self.done = set()
        for turtle in ("turtle1", "turtle2"):
            self.ends[turtle] = self.create_publisher(Twist, f"{turtle}/cmd_vel", 10)

    def do(self, number, method, arguments):
        if number not in self.done:
            self.done.add(number)
            getattr(self, method)(*arguments)

    def swim(self, turtle, x=0.0, y=0.0, turn=0.0):
        self.ends[turtle].publish(Twist(linear=Vector3(x=x, y=y), angular=Vector3(z=turn)))

    def call(self, kind, name, /, **fields):
        client = self.ends.setdefault(name, None) or self.create_client(kind, name)
        self.ends[name] = client
        client.wait_for_service()
        client.call_async(kind.Request(**fields)).add_done_callback(self.tell)

    def tell(self, future):
        if hasattr(future.result(), "name"):
            self.get_logger().info(f"Its name is {future.result().name!r}")

    def spawn(self, name="", **fields):
        self.call(Spawn, "spawn", name=name, **({"x": 2.0, "y": 2.0, "theta": 0.2} | fields))

    def odd(self):
        self.spawn(x=float("nan"))

    def kill(self, name):
        self.call(Kill, "kill", name=name)

    def clear(self):
        self.call(Empty, "clear")

    def reset(self):
        self.call(Empty, "reset")

    def pen(self, r=0, g=0, b=0, width=0, off=0):
        self.call(SetPen, "turtle1/set_pen", r=r, g=g, b=b, width=width, off=off)

    def lift(self):
        self.pen(off=1)

    def jump(self, linear, angular):
        self.call(TeleportRelative, "turtle1/teleport_relative", linear=linear, angular=angular)

    def jump_to(self, x, y, theta):
        self.call(TeleportAbsolute, "turtle1/teleport_absolute", x=x, y=y, theta=theta)

    def rotate(self, turtle, theta):
        client = ActionClient(self, RotateAbsolute, f"{turtle}/rotate_absolute")
        client.wait_for_server()
        client.send_goal_async(RotateAbsolute.Goal(theta=theta)).add_done_callback(self.on_response)

    def on_response(self, future):
        self.goal = future.result()
        if self.goal.accepted:
            self.goal.get_result_async()

    def cancel(self):
        self.goal.cancel_goal_async()

    def set(self, name, value):
        from rclpy.parameter_client import AsyncParameterClient

        client = self.ends.setdefault("parameters", None) or AsyncParameterClient(self, "turtlesim")
        self.ends["parameters"] = client
        client.wait_for_services()
        client.set_parameters([Parameter(name, value=value)]).add_done_callback(self.answer)

    def answer(self, future):
        (result,) = future.result().results
        self.get_logger().info(f"Set: {result.successful} {result.reason}".strip())


def script(*steps):
    """A node of this script."""
    return type("Script", (Script,), {"steps": steps})
