"""A simulated robot for ROS 2 nodes: run them on the real rclpy, in simulated time; see what they did."""

from sim import environment

environment.prepare()

from sim.play import play  # noqa: E402
from sim.recording import Recording  # noqa: E402
from sim.ros import hooks  # noqa: E402
from sim.ros.processes import Process  # noqa: E402
from sim.ros.run import run  # noqa: E402
from sim.ros.teleop import Teleop  # noqa: E402
from sim.world import World  # noqa: E402

hooks.install()  # last: what the engine itself has bound are the real clocks

__all__ = ["Process", "Recording", "Teleop", "World", "play", "run"]
