"""Lock-step simulated time on the real rclpy. The only part of `sim` that knows ROS."""
