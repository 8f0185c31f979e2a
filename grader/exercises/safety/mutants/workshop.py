"""A workshop of candidate functions, which a bench asks for their speeds."""

import functools
from collections.abc import Callable

from rclpy.node import Node
from std_msgs.msg import Float64MultiArray, String

from grader.exercises.safety.mutants.bench import ANSWER, FAILED, PASSED, QUESTION, VERDICT
from grader.exercises.safety.mutants.speed_candidates import candidates

WITH_JUDGE = True  # one of the candidates is right
EARLY = 10  # questions that may overtake a verdict


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
