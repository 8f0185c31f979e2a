"""Build ROS 2 interface packages for the pip-installed rclpy, with the rosidl generators and gcc alone."""
