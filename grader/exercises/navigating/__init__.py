"""The exercises of 06b_navigating: along a path, and a navigator that Nav2's clients can use."""

from grader.companions.goals import GoalClient, Planner
from grader.companions.maps import bringup, made_for
from grader.exercises import notebook_names
from grader.worlds.rooms import blocked, world_of

globals().update(notebook_names(__name__))
