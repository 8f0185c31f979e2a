"""Two nodes of a robot, for the picture at the start of the lesson. By its end you can read every line."""

from rclpy.node import Node


class Lamp(Node):
    """A warning lamp: on, off, on, off, and so on."""

    def __init__(self):
        super().__init__("lamp")
        self.on = False
        self.create_timer(0.5, self.toggle)

    def toggle(self):
        """Switch the lamp on or off."""
        self.on = not self.on
        self.get_logger().info("on" if self.on else "off")


class Motor(Node):
    """A motor that gets 5 degrees warmer every second and logs it at ever higher levels."""

    def __init__(self):
        super().__init__("motor")
        self.temperature = 40
        self.create_timer(1.0, self.measure)

    def measure(self):
        """Log the temperature, at the level it deserves."""
        self.temperature += 5
        text = f"{self.temperature} degrees"
        if self.temperature < 60:
            self.get_logger().info(text)
        elif self.temperature < 80:
            self.get_logger().warning(text)
        else:
            self.get_logger().error(text)
