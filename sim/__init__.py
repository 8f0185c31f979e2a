"""A simulated robot for ROS 2 nodes: run them on the real rclpy, in simulated time; inspect recordings."""

from sim import ros_environment

ros_environment.prepare()

from sim import notebook  # noqa: E402
from sim.evidence import Recording, since_start  # noqa: E402
from sim.network import Network  # noqa: E402
from sim.play import play, replay  # noqa: E402
from sim.ros.engine.program import Process  # noqa: E402
from sim.ros.exploring import explore  # noqa: E402
from sim.ros.hooks.install import install  # noqa: E402
from sim.ros.packages import executable  # noqa: E402
from sim.ros.play.teleop import Teleop  # noqa: E402
from sim.ros.run import run  # noqa: E402
from sim.ros.sourcing import source  # noqa: E402
from sim.ros2 import register_magic  # noqa: E402
from sim.world import World  # noqa: E402

Recording.player = replay
notebook.watch_cells()
install()  # after all imports, so that the engine's own modules have bound the real clocks
register_magic()

__all__ = [
    "Network",
    "Process",
    "Recording",
    "Teleop",
    "World",
    "executable",
    "explore",
    "play",
    "run",
    "since_start",
    "source",
]
