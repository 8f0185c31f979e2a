"""A weather station and a voltage probe, which programs of packages subscribe to."""

import random

from rclpy.node import Node
from std_msgs.msg import Float32

TEMPERATURE, VOLTS = "/temperature", "/volts"


class WeatherStation(Node):
    """Publishes temperatures (Float32 on /temperature) at 2 Hz."""

    def __init__(self, seed: int) -> None:
        super().__init__("weather")
        rng = random.Random(f"weather {seed}")
        self.left = [rng.randrange(-200, 400) / 10 for _ in range(100)]
        self.publisher = self.create_publisher(Float32, TEMPERATURE, 10)
        self.create_timer(0.5, self.measure)

    def measure(self) -> None:
        """Publish the next temperature."""
        self.publisher.publish(Float32(data=self.left.pop()))


class VoltageProbe(Node):
    """Publishes voltages (Float32 on /volts) at 4 Hz; some are out of range."""

    def __init__(self, seed: int) -> None:
        super().__init__("probe")
        rng = random.Random(f"probe {seed}")
        self.left = [round(rng.uniform(0.0, 3.3), 3) for _ in range(60)]
        for _ in range(12):
            self.left[rng.randrange(50, 60)] = rng.choice([-0.2, -0.01, 3.35, 5.0])
        self.publisher = self.create_publisher(Float32, VOLTS, 10)
        self.create_timer(0.25, self.measure)

    def measure(self) -> None:
        """Publish the next voltage."""
        self.publisher.publish(Float32(data=self.left.pop()))
