"""Imports all modules that a judge or a student's process needs, once in the processes that fork them.

Nothing in here may start a thread or open a ROS context: neither survives a fork.
"""

import contextlib
import importlib.util
import pkgutil
import re
import sys

import IPython.core.application
import IPython.core.completerlib
import IPython.core.interactiveshell
import IPython.core.magics  # noqa: F401
import matplotlib.pyplot  # noqa: F401
import matplotlib_inline.backend_inline  # noqa: F401
import nbformat
import PIL.Image

import grader.pictures  # noqa: F401
import sim.ros
import sim.view
from grader.catalog import exercises
from sim.ros.robots.sensor_messages import SensorMessages
from sim.view.plot import plot
from sim.world import World, WorldError

LATER = "service_msgs.msg", "type_description_interfaces.msg"  # rclpy imports them for the first node

exercises()
for name in LATER:
    importlib.import_module(name)
for module in pkgutil.walk_packages(sim.ros.__path__, "sim.ros."):
    importlib.import_module(module.name)
for name in [name for name in sys.modules if re.fullmatch(r"\w+\.(msg|srv|action)", name)]:
    package = name.split(".")[0]
    support = f"{package}.{package}_s__rosidl_typesupport_c"  # otherwise loaded with the first message
    if importlib.util.find_spec(support):
        importlib.import_module(support)
for name in World.names():
    with contextlib.suppress(WorldError):  # a run in this world reports the error; others are not affected
        SensorMessages(World.load(name).lidar)  # compiles what the first message of a type needs
PIL.Image.preinit()
sim.view.png(plot(1, 1)[0])  # the first figure searches for fonts
nbformat.validate(nbformat.v4.new_notebook())  # the first call compiles the format's schema
