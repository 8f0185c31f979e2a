"""A node publishes the right values, thousands at once."""

# %% temperature
class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "/sensor/temperature", 10)
        self.create_timer(0.1, self.flood)

    def flood(self):
        for _ in range(2_000):
            self.publisher.publish(Float32(data=22.0))
