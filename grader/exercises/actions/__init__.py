"""The exercises of 04_actions, from a first action server to a square out of actions."""

from grader.companions.action_servers import (
    BusyFibonacci,
    CarpetServer,
    DriveServer,
    LateFibonacci,
    SpinServer,
)
from grader.companions.goal_senders import Captain, Examiner, Impatient, Mathematician
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))
