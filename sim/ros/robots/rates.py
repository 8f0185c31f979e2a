"""Rates of the topics that robots and machines publish and subscribe to."""

SENSOR_RATE = 20
"""Hz; of most sensors, and of recorded paths."""
MAX_COMMAND_RATE = 1000
"""Hz; ten times the rate of the fastest real robots. Above it, a robot logs a warning."""
