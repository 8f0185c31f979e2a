"""The exercises of 06_navigator, from the way to a goal to a navigator that Nav2's clients can use."""

from grader.companions.blind_drivers import Wanderer
from grader.companions.goals import GoalClient, GoalSender, Planner
from grader.companions.maps import CostmapServer, Localization, MapServer, PointClicker, bringup, made_for
from grader.exercises.navigator.bearing import compass
from grader.exercises.navigator.driving import drive
from grader.exercises.navigator.following import follow
from grader.exercises.navigator.mapping import costmap
from grader.exercises.navigator.navigating import navigate
from grader.exercises.navigator.planning import plan
from grader.worlds.rooms import blocked, world_of

__all__ = [
    "CostmapServer",
    "GoalClient",
    "GoalSender",
    "Localization",
    "MapServer",
    "Planner",
    "PointClicker",
    "Wanderer",
    "blocked",
    "bringup",
    "compass",
    "costmap",
    "drive",
    "follow",
    "made_for",
    "navigate",
    "plan",
    "world_of",
]
