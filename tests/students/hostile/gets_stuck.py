"""A loop without end, as soon as everything was right for a moment: what comes later can't be wrong."""

# %% temperature
class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.publisher = self.create_publisher(Float32, "/sensor/temperature", 10)
        self.create_timer(1.0, self.measure)
        self.create_timer(2.2, self.stop_here)

    def measure(self):
        self.publisher.publish(Float32(data=random.uniform(20.0, 25.0)))

    def stop_here(self):
        while True:
            pass
