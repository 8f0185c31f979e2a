"""A bench that runs a student's tests on the candidates of a workshop, which it asks for their speeds."""

from collections.abc import Callable

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray, String

QUESTION, ANSWER, VERDICT = "/question", "/answer", "/verdict"
PASSED, FAILED = "passed", "failed"
Speed = Callable[[float, float], float]
Test = Callable[[Speed], None]


class Bench(Node):
    """Runs tests on candidates, and publishes "4 passed" or "4 failed" on /verdict (String)."""

    def __init__(self, tests: tuple[Test, ...]) -> None:
        super().__init__("bench")
        self.tests, self.speed = tests, None
        self.questions = self.create_publisher(Float64MultiArray, QUESTION, 10)
        self.verdicts = self.create_publisher(String, VERDICT, 10)
        self.create_subscription(Float64MultiArray, ANSWER, self.on_answer, 10)

    def on_answer(self, answer: Float64MultiArray) -> None:
        """Store the candidate's speed."""
        self.speed = answer.data[-1]

    def speed_of(self, number: int, distance: float, requested: float) -> float:
        """Return the speed of candidate `number`, m/s."""
        self.speed = None
        self.questions.publish(Float64MultiArray(data=[float(number), float(distance), float(requested)]))
        while self.speed is None:
            rclpy.spin_once(self)
        return self.speed

    def verdict(self, number: int) -> str:
        """Return whether a candidate passes all tests. Raises what a test raises, except AssertionError."""

        def safe_speed(distance: float, requested: float) -> float:
            return self.speed_of(number, distance, requested)

        for test in self.tests:
            try:
                test(safe_speed)
            except AssertionError:
                return FAILED
        return PASSED


def bench(*tests: Test) -> Callable[[], None]:
    """Return a program that runs these tests on all thirteen candidates."""

    def main() -> None:
        rclpy.init()
        node = Bench(tests)
        rclpy.spin_once(node, timeout_sec=0.5)  # two programs need a moment to discover each other
        while not (node.questions.get_subscription_count() and node.count_publishers(ANSWER)):
            rclpy.spin_once(node, timeout_sec=0.1)
        for number in range(1, 14):
            node.verdicts.publish(String(data=f"{number} {node.verdict(number)}"))
        rclpy.spin_once(node, timeout_sec=0.1)
        rclpy.try_shutdown()

    return main
