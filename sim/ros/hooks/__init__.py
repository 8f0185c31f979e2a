"""Everything in rclpy and Python that a run replaces, with the reason."""
