"""A weather station, a voltage probe and a wheel encoder, which programs of packages subscribe to."""

import random

from rclpy.node import Node
from std_msgs.msg import Float32, Int32

TEMPERATURE, VOLTS, TICKS = "/temperature", "/volts", "/ticks"
EDGES = 0.0, 0.5, 3.3  # V: the two limits, and what becomes 0 degrees


class WeatherStation(Node):
    """Publishes temperatures (Float32 on /temperature) at 2 Hz."""

    def __init__(self, seed: int) -> None:
        super().__init__("weather")
        rng = random.Random(f"weather {seed}")
        temperatures = [rng.randrange(-200, 400) / 10 for _ in range(100)]
        publisher = self.create_publisher(Float32, TEMPERATURE, 10)
        self.create_timer(0.5, lambda: publisher.publish(Float32(data=temperatures.pop())))


class VoltageProbe(Node):
    """Publishes voltages (Float32 on /volts) at 4 Hz; some are out of range."""

    def __init__(self, seed: int) -> None:
        super().__init__("probe")
        rng = random.Random(f"probe {seed}")
        voltages = [round(rng.uniform(0.0, 3.3), 3) for _ in range(60)]
        for _ in range(12):
            voltages[rng.randrange(50, 60)] = rng.choice([-0.2, -0.01, 3.35, 5.0])
        for place, volts in zip(rng.sample(range(42, 58), len(EDGES)), EDGES, strict=True):
            voltages[place] = volts
        publisher = self.create_publisher(Float32, VOLTS, 10)
        self.create_timer(0.25, lambda: publisher.publish(Float32(data=voltages.pop())))


class WheelEncoder(Node):
    """Publishes how far a wheel has turned, in ticks (Int32 on /ticks) at 4 Hz; it may turn back below 0."""

    def __init__(self, seed: int) -> None:
        super().__init__("encoder")
        rng = random.Random(f"encoder {seed}")
        counts = [rng.randrange(-2000, 9000) for _ in range(100)]
        publisher = self.create_publisher(Int32, TICKS, 10)
        self.create_timer(0.25, lambda: publisher.publish(Int32(data=counts.pop())))
