"""The exercises of 10_control, from measuring a stream to a pole that is pushed."""

from grader.companions.control_streams import Camera, Marks, Sensor
from grader.exercises import notebook_names
from grader.worlds.carts import hopeless_cart, long_track, pushed_cart, weak_cart, work_cart
from grader.worlds.frame_worlds import ramp

globals().update(notebook_names(__name__))
