"""Upstream's sensor_msgs_py, as far as the course uses it: point clouds as numpy arrays and back."""
