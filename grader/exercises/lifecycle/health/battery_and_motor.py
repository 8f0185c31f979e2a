"""A battery and a motor that get tired, hot, and silent."""

import random

from sensor_msgs.msg import BatteryState, Temperature

from grader.companions.drivers import TimedNode

BATTERY, MOTOR = "/battery_state", "/motor_temperature"
LEVELS = {
    BATTERY: ((0.32, 0.95), (0.12, 0.28), (0.02, 0.08), None),
    MOTOR: ((20.0, 58.0), (62.0, 78.0), (82.0, 99.0), None),
}
EDGES = {BATTERY: (0.3, 0.29, 0.0, None), MOTOR: (59.9, 60.0, 80.0, None)}
"""A value of each level at its edge."""


class BatteryAndMotor(TimedNode):
    """A battery (BatteryState, percentage 0 to 1) and a motor (Temperature, Celsius), 5 times a second."""

    period, phase = 0.2, 2.6  # s

    def __init__(self) -> None:
        super().__init__("patient")
        self.plan = {topic: self._drawn(*levels, at_edges=EDGES[topic]) for topic, levels in LEVELS.items()}
        self.batteries = self.create_publisher(BatteryState, BATTERY, 10)
        self.motors = self.create_publisher(Temperature, MOTOR, 10)

    def _drawn(self, *levels: tuple[float, float] | None,
               at_edges: tuple[float | None, ...]) -> list[float | None]:
        """Return each level once, at its edge, and one of them again, somewhere in its range."""
        order = random.sample(levels, 4)
        while order[0] is None:
            random.shuffle(order)
        low, high = random.choice([level for level in levels if level])
        return [*(at_edges[levels.index(level)] for level in order), round(random.uniform(low, high), 3)]

    def tick(self, now: float) -> None:
        """Publish the state of both, unless silent."""
        level, heat = (self.plan[topic][min(int(now / self.phase), 4)] for topic in (BATTERY, MOTOR))
        stamp = self.get_clock().now().to_msg()
        if level is not None:
            msg = BatteryState(percentage=level)
            msg.header.stamp = stamp
            self.batteries.publish(msg)
        if heat is not None:
            msg = Temperature(temperature=heat)
            msg.header.stamp = stamp
            self.motors.publish(msg)
