"""rclpy is shut down behind everybody's back, again and again."""

# %% square
import rclpy


class SquareDriver(Node):
    def __init__(self):
        super().__init__("square_driver")
        self.create_timer(0.1, self.stop)

    def stop(self):
        rclpy.shutdown()
