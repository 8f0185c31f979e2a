"""The verbs of each command; `sim.ros2.parser` combines them."""
