"""Every place where a run reaches into rclpy or Python, with the reason."""
