"""Programs whose services and topics students' clients use: a door, an adder, wheels, a raw gyro."""

import random

from example_interfaces.srv import AddTwoInts
from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Float64, Int64
from std_srvs.srv import Trigger

from grader.companions.service_clients import call_at
from sim.evidence import since_start

REFUSALS = ("The door is locked.", "Someone is in the way.", "The doorman is at lunch.",
            "Please wait a moment.")


class Door(Node):
    """Offers /door/open (Trigger), but only from 2 or 3 s on; refuses two or three times, then opens."""

    def __init__(self) -> None:
        super().__init__("door")
        self.refusals = random.sample(REFUSALS, random.randint(2, 3))
        call_at(self, random.uniform(2.1, 3.4), self.open_up)

    def open_up(self) -> None:
        """Offer the service."""
        try:
            self.create_service(Trigger, "/door/open", self.answer)
        except RuntimeError:  # RCLError, if the student's client is of another type
            self.get_logger().info("/door/open is used with another type")

    def answer(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Refuse as long as there is a refusal left."""
        self.get_clock().sleep_for(Duration(seconds=0.2))  # it takes a moment
        response.success = not self.refusals
        response.message = "The door is open." if response.success else self.refusals.pop()
        return response


class SlowAdder(Node):
    """Offers /add_two_ints (AddTwoInts), and takes 0.3 s for each answer."""

    def __init__(self) -> None:
        super().__init__("slow_adder")
        self.create_service(AddTwoInts, "/add_two_ints", self.add)

    def add(self, request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
        """Wait, then add."""
        self.get_clock().sleep_for(Duration(seconds=0.3))
        response.sum = request.a + request.b
        return response


class WheelEncoders(Node):
    """Counts the ticks of two wheels that turn: Int64 on /ticks/left and /ticks/right, 5 times a second."""

    def __init__(self) -> None:
        super().__init__("wheels")
        self.counts = [random.randint(1, 9), random.randint(1, 9)]
        self.sides = [self.create_publisher(Int64, f"/ticks/{side}", 10) for side in ("left", "right")]
        self.create_timer(0.2, self.turn)

    def turn(self) -> None:
        """Turn a bit further, by different amounts on the two sides."""
        for side, publisher in enumerate(self.sides):
            self.counts[side] += random.randint(3, 20)
            publisher.publish(Int64(data=self.counts[side]))


class RawGyro(Node):
    """A gyro on a robot at rest: Float64 in rad/s on /gyro/raw at 50 Hz, from 1 s on.

    It should read 0, but reads a small bias and some noise. At 6 s it has warmed up and has another bias.
    """

    def __init__(self) -> None:
        super().__init__("raw_gyro")
        self.publisher = self.create_publisher(Float64, "/gyro/raw", 10)
        self.biases = [random.choice((-1, 1)) * random.uniform(0.05, 0.2) for _ in range(2)]
        self.create_timer(0.02, self.measure)

    def measure(self) -> None:
        """Publish a reading."""
        now = since_start(self.get_clock().now().to_msg())
        if now > 0.99:
            self.publisher.publish(Float64(data=self.biases[now >= 6.0] + random.gauss(0.0, 0.004)))
