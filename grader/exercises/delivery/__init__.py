"""The exercises of 13b_delivery, the delivery robot: from perception to one that drives."""

from grader.companions.blind_drivers import turner
from grader.companions.map_messages import LATCHED, pose_2d, pose_array, pose_stamped, seconds
from grader.exercises import notebook_names
from grader.geometry.floor import Floor, away_from, points_of, steer
from grader.worlds.warehouses import floor_of, warehouse

globals().update(notebook_names(__name__))
