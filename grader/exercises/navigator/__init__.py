"""The exercises of 06_navigator, from the path to a goal to a navigator that Nav2's clients can use."""

from grader.companions.blind_drivers import Wanderer
from grader.companions.goals import GoalClient, GoalSender, Planner
from grader.companions.maps import CostmapServer, Localization, MapServer, PointClicker, bringup, made_for
from grader.exercises.navigator.compass import compass
from grader.exercises.navigator.costmap import costmap
from grader.exercises.navigator.drive import drive
from grader.exercises.navigator.follow import follow
from grader.exercises.navigator.navigate import navigate
from grader.exercises.navigator.plan import plan
from grader.worlds.rooms import blocked, world_of
