"""Three programs that send two parcels, one parcel, and a request for a report, all at the same moment."""

from functools import partial

from rclpy.node import Node
from std_msgs.msg import String

SENDS_AT = 1.0  # s


class Sender(Node):
    """Publishes its messages once, one directly after the other."""

    def __init__(self, topic: str, texts: tuple[str, ...]) -> None:
        super().__init__(f"{topic}_sender")
        self.texts = texts
        self.publisher = self.create_publisher(String, f"/{topic}", 10)
        self.timer = self.create_timer(SENDS_AT, self.send)

    def send(self) -> None:
        """Publish all."""
        self.timer.cancel()
        for text in self.texts:
            self.publisher.publish(String(data=text))


senders = [partial(Sender, "left", ("A", "B")), partial(Sender, "right", ("C",)),
           partial(Sender, "report", ("report",))]  # fmt: skip
