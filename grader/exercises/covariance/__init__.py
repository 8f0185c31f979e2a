"""The exercises of 14b_covariance: odometry that states how uncertain it is, and wheels and gyro fused."""

from grader.companions.blind_drivers import Circling
from grader.exercises import notebook_names
from grader.worlds.slippery import slippery_floor

globals().update(notebook_names(__name__))
