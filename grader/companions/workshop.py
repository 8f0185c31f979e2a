"""A workshop of candidate functions, and a bench that runs a student's tests on them."""

import functools
from collections.abc import Callable

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray, String

from grader.companions.speed_candidates import Speed, candidates

QUESTION, ANSWER, VERDICT = "/question", "/answer", "/verdict"
PASSED, FAILED = "passed", "failed"
EARLY = 10  # questions that may overtake a verdict
Test = Callable[[Speed], None]


class Workshop(Node):
    """Answers on /answer the questions on /question, both Float64MultiArray.

    A question is a candidate's number from 1 on, a distance in m and a requested speed in m/s; the answer is
    these three and the candidate's speed in m/s. Candidates take turns: each answers from the verdict on the
    one before it to its own verdict, on /verdict. Other questions get no answer.
    """

    def __init__(self, seed: int) -> None:
        super().__init__("workshop")
        self.candidates = [function for _, function in candidates(seed)]
        self.answers = self.create_publisher(Float64MultiArray, ANSWER, 10)
        self.current = 1
        self.early: list[Float64MultiArray] = []  # questions to the next one, which overtook a verdict
        self.create_subscription(Float64MultiArray, QUESTION, self.on_question, 10)
        self.create_subscription(String, VERDICT, self.on_verdict, 10)

    def on_question(self, question: Float64MultiArray) -> None:
        """Answer it, now or after the verdict that it has overtaken."""
        if len(question.data) != 3 or question.data[0] not in range(1, len(self.candidates) + 1):
            return
        if question.data[0] == self.current:
            self.answer(question)
        elif question.data[0] == self.current + 1:
            self.early = [*self.early, question][-EARLY:]

    def on_verdict(self, verdict: String) -> None:
        """Go on to the next candidate."""
        if verdict.data in (f"{self.current} {PASSED}", f"{self.current} {FAILED}"):
            self.current, questions, self.early = self.current + 1, self.early, []
            for question in questions:
                self.answer(question)

    def answer(self, question: Float64MultiArray) -> None:
        """Call the candidate, and publish its speed."""
        number, distance, requested = question.data
        speed = self.candidates[int(number) - 1](distance, requested)
        self.answers.publish(Float64MultiArray(data=[number, distance, requested, speed]))


def workshop(seed: int) -> list[Callable[[], Node]]:
    """Return the workshop of a seed, as companions of a run."""
    return [functools.partial(Workshop, seed)]


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
