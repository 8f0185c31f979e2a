"""A simulated robot for ROS 2 nodes: run them on the real rclpy, in simulated time; inspect recordings."""

import signal
import sys
from pathlib import Path

from sim import ros_environment

ros_environment.prepare()

# The command `ros2` uses a few modules of this package alone, and starts in half the time without the others.
if Path(sys.argv[0]).name == "ros2":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it quietly, even while it still imports
else:
    from sim.public_names import (
        Network,
        Pointer,
        Process,
        Recording,
        Teleop,
        World,
        executable,
        explore,
        play,
        run,
        schedule,
        since_start,
        source,
    )

__all__ = [
    "Network",
    "Pointer",
    "Process",
    "Recording",
    "Teleop",
    "World",
    "executable",
    "explore",
    "play",
    "run",
    "schedule",
    "since_start",
    "source",
]
