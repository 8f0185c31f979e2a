"""A node makes and destroys others, as fast as it can."""

# %% temperature
import rclpy


class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.create_timer(0.001, self.multiply)

    def multiply(self):
        for number in range(200):
            node = rclpy.create_node(f"n{number}")
            node.create_publisher(Float32, "/sensor/temperature", 10).publish(Float32(data=22.0))
            node.destroy_node()
