"""The exercises of 04_actions, from a first action server to a square out of actions."""

from grader.companions.action_servers import (
    BusyFibonacci,
    CarpetServer,
    DriveServer,
    LateFibonacci,
    SpinServer,
)
from grader.companions.goal_senders import Captain, Examiner, Impatient, Mathematician
from grader.exercises.actions.courier import courier
from grader.exercises.actions.customer import customer
from grader.exercises.actions.fibonacci import fibonacci
from grader.exercises.actions.square import square
from grader.exercises.actions.steps import steps
from grader.exercises.actions.stoppable import stoppable
from grader.exercises.actions.turn import turn
