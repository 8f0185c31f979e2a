"""The exercises of 06_navigator, from the bearing of a goal to the path to it on a map."""

from grader.companions.blind_drivers import Wanderer
from grader.companions.goals import GoalClient, GoalSender
from grader.companions.maps import CostmapServer, Localization, MapServer, PointClicker, bringup, made_for
from grader.exercises import notebook_names
from grader.worlds.rooms import blocked, world_of

globals().update(notebook_names(__name__))
