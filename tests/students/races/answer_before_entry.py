"""The answer comes between sending a request and noting that it is expected (as in rclpy#1123)."""

import threading

from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Int32

SHORTLY = Duration(seconds=0.1)


class Asks(Node):
    """A thread asks on /ask and waits for the answer on /answer."""

    def __init__(self):
        super().__init__("asks")
        self.expected = {}
        self.answered = 0
        self.publisher = self.create_publisher(Int32, "ask", 10)
        self.create_subscription(Int32, "answer", self.on_answer, 10)
        threading.Thread(target=self.work, daemon=True).start()
        self.create_timer(3.0, self.look)

    def work(self):
        while self.publisher.get_subscription_count() == 0 or self.count_publishers("answer") == 0:
            self.get_clock().sleep_for(SHORTLY)
        self.get_clock().sleep_for(SHORTLY)
        for number in range(3):
            self.ask(number).wait()
            self.answered += 1

    def ask(self, number):
        self.publisher.publish(Int32(data=number))
        arrived = threading.Event()
        self.expected[number] = arrived
        return arrived

    def on_answer(self, message):
        arrived = self.expected.pop(message.data, None)
        if arrived is not None:
            arrived.set()

    def look(self):
        assert self.answered == 3, f"{self.answered} of 3 answers"


class NotesFirst(Asks):
    """Notes that it expects an answer before it asks."""

    def ask(self, number):
        arrived = threading.Event()
        self.expected[number] = arrived
        self.publisher.publish(Int32(data=number))
        return arrived


class Answers(Node):
    """Answers each number with itself."""

    def __init__(self):
        super().__init__("answers")
        publisher = self.create_publisher(Int32, "answer", 10)
        self.create_subscription(Int32, "ask", publisher.publish, 10)


WRONG, RIGHT = (Asks, Answers), (NotesFirst, Answers)
