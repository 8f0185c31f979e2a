"""The public names of `sim`. The first import of this module installs the hooks and the magic `%ros2`."""

from sim import notebook
from sim.evidence import Recording, since_start
from sim.network import Network
from sim.play import play, replay
from sim.ros.engine.program import Process
from sim.ros.exploring import explore, schedule
from sim.ros.hooks.install import install
from sim.ros.packages import executable
from sim.ros.play.pointer import Pointer
from sim.ros.play.teleop import Teleop
from sim.ros.run import run
from sim.ros.sourcing import source
from sim.ros2 import register_magic
from sim.world import World

Recording.player = replay
notebook.watch_cells()
install()  # after all imports, so that the engine's own modules have bound the real clocks
register_magic()

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
