"""The part of upstream's sensor_msgs_py that the course uses: point clouds as numpy arrays and back."""
