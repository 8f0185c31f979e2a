"""The exercises of 10_control, from measuring a stream to a pole that is pushed."""

from grader.companions.control_streams import Camera, Marks, Sensor
from grader.companions.slope import Slope
from grader.exercises.control.balance import balance
from grader.exercises.control.gap import gap
from grader.exercises.control.jitter import jitter
from grader.exercises.control.marks import marks
from grader.exercises.control.push import push
from grader.exercises.control.worker import worker
from grader.worlds.carts import hopeless_cart, long_track, pushed_cart, weak_cart, work_cart
from grader.worlds.frame_worlds import ramp
