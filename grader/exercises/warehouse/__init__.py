"""The exercises of 13_warehouse: the delivery robot's graph on paper, and a database that takes its time."""

from grader.companions.map_messages import LATCHED
from grader.exercises import notebook_names
from grader.worlds.warehouses import hall

globals().update(notebook_names(__name__))
