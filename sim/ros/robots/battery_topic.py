"""Publishes a robot's battery."""

from __future__ import annotations

from rclpy.node import Node
from sensor_msgs.msg import BatteryState

from sim.world import Battery


class BatteryTopic:
    """Publishes battery_state (sensor_msgs/BatteryState): V, A, A h; `percentage` is from 0 to 1."""

    def __init__(self, node: Node, battery: Battery, frame: str) -> None:
        self._node, self._battery, self._frame = node, battery, frame
        self._publisher = node.create_publisher(BatteryState, "battery_state", 10)

    def publish(self) -> None:
        """Publish the current state."""
        battery, model = self._battery, self._battery.model
        message = BatteryState(
            voltage=battery.voltage,
            temperature=float("nan"),  # NaN means not measured
            current=battery.current,
            charge=battery.charge,
            capacity=model.capacity,
            design_capacity=model.capacity,
            percentage=battery.percentage,
            power_supply_status=_status(battery),
            power_supply_health=BatteryState.POWER_SUPPLY_HEALTH_GOOD,
            power_supply_technology=BatteryState.POWER_SUPPLY_TECHNOLOGY_LION,
            present=True,
        )
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.header.frame_id = self._frame
        self._publisher.publish(message)


def _status(battery: Battery) -> int:
    if battery.current > 0:
        return BatteryState.POWER_SUPPLY_STATUS_CHARGING
    if battery.current < 0:
        return BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
    return BatteryState.POWER_SUPPLY_STATUS_FULL
