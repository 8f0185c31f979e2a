"""Answers about eight traces: right ones, and wrong ones named after their defect."""

import contextlib

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String

LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Answers(Node):
    """Nothing is wrong with it; the others change one thing each."""

    single, exclusive, reentrant = (1, 2), (1, 2, 4, 8), (1, 2, 3, 4, 5, 6, 8)

    def __init__(self):
        super().__init__("answers")
        self.publisher = self.create_publisher(String, "/possible", LATCHED)
        for executor in ("single", "exclusive", "reentrant"):
            self.answer(executor, getattr(self, executor))

    def answer(self, executor, numbers):
        self.publisher.publish(String(data=f"{executor}: {' '.join(map(str, sorted(numbers)))}"))


class WithCommas(Answers):
    """Commas between the numbers, in any order."""

    def answer(self, executor, numbers):
        self.publisher.publish(String(data=f"{executor}:{', '.join(map(str, sorted(numbers)[::-1]))}"))


class EverySecond(Answers):
    """Publishes its answers again and again; the last one counts."""

    single = (3,)

    def __init__(self):
        super().__init__()
        self.create_timer(0.3, self.again)

    def again(self):
        for executor in ("single", "exclusive", "reentrant"):
            self.answer(executor, getattr(Answers, executor))


class Reasons(Answers):
    """A design of its own: states for each trace what it needs, and derives the answers from that."""

    def answer(self, executor, numbers):
        needs = {1: "", 2: "", 3: "overtaking", 4: "report", 5: "parcels", 6: "parcels", 7: "magic",
                 8: "report"}  # fmt: skip
        offers = {"single": [""], "exclusive": ["", "report"],
                  "reentrant": ["", "report", "parcels", "overtaking"]}  # fmt: skip
        super().answer(executor, {n for n, need in needs.items() if need in offers[executor]})


class Supersets(Answers):
    """A design of its own: each executor permits what the previous one does, and more."""

    exclusive = (*Answers.single, 4, 8)
    reentrant = (*range(1, 7), 8)


def main():
    """As a program, with a latched topic for a late listener."""
    rclpy.init()
    node = rclpy.create_node("answers")
    publisher = node.create_publisher(String, "/possible", LATCHED)
    for text in ("single: 1 2", "exclusive: 1 2 4 8", "reentrant: 1 2 3 4 5 6 8"):
        publisher.publish(String(data=text))
    with contextlib.suppress(KeyboardInterrupt):
        rclpy.spin(node)


class AtomicBecauseOfTheGil(Answers):
    reentrant = (1, 2, 3, 4, 8)


class AllIsPossible(Answers):
    single = exclusive = reentrant = tuple(range(1, 9))


class NothingIsPossible(Answers):
    single = exclusive = reentrant = ()


class ThreadsLikeOneThread(Answers):
    exclusive = reentrant = Answers.single


class OneThreadLikeGroups(Answers):
    single = Answers.exclusive


class GroupsLikeReentrant(Answers):
    exclusive = Answers.reentrant


class TopicsHaveAnOrder(Answers):
    single = (1,)


class OvertakesInOneThread(Answers):
    single = (1, 2, 3)


class OvertakesInAGroup(Answers):
    exclusive = (1, 2, 3, 4, 8)


class NothingOvertakes(Answers):
    reentrant = (1, 2, 4, 5, 6, 8)


class PrintedWhenRead(Answers):
    """It takes the order of the lines for the order of what happened."""

    exclusive, reentrant = (1, 2, 4), (1, 2, 3, 4, 5, 8)


class ReportsWait(Answers):
    exclusive = (1, 2, 8)


class FromNowhere(Answers):
    single, exclusive, reentrant = (1, 2, 7), (1, 2, 4, 7, 8), tuple(range(1, 9))


class FewerWithThreads(Answers):
    exclusive, reentrant = (1, 4, 8), (1, 3, 4, 5, 6, 8)


class OtherNames(Answers):
    def answer(self, executor, numbers):
        super().answer(executor.replace("single", "one thread"), numbers)


class Letters(Answers):
    def answer(self, executor, numbers):
        super().answer(executor, {"abcdefgh"[number - 1] for number in numbers})


class OnAnotherTopic(Answers):
    def answer(self, executor, numbers):
        self.create_publisher(String, "/answers", LATCHED).publish(String(data=f"{executor}: 1 2"))


class Counts(Answers):
    """It publishes how many traces are possible."""

    def __init__(self):
        Node.__init__(self, "answers")
        self.publisher = self.create_publisher(Int32, "/possible", LATCHED)
        for numbers in (self.single, self.exclusive, self.reentrant):
            self.publisher.publish(Int32(data=len(numbers)))
