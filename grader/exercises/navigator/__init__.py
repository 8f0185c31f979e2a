"""The exercises of 06_navigator, from the path to a goal to a navigator that Nav2's clients can use."""

from grader.companions.blind_drivers import Wanderer
from grader.companions.goals import GoalClient, GoalSender, Planner
from grader.companions.maps import CostmapServer, Localization, MapServer, PointClicker, bringup, made_for
from grader.exercises import notebook_names
from grader.worlds.rooms import blocked, world_of

globals().update(notebook_names(__name__))
