"""The exercises of 13_delivery, the delivery robot: from the graph on paper to one that drives."""

from grader.companions.blind_drivers import turner
from grader.companions.map_messages import LATCHED, pose_2d, pose_array, pose_stamped, seconds
from grader.exercises import notebook_names
from grader.geometry.floor import Floor, away_from, points_of, steer
from grader.worlds.warehouses import floor_of, hall, warehouse

globals().update(notebook_names(__name__))
