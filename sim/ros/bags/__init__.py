"""Bags: recorded messages in files, as `ros2 bag` writes and reads them, and as the world of a run."""
