"""The exercises of 08_joints, from seven positions to an arm that draws."""

from grader.companions.lift import lift
from grader.exercises.joints.arriving import arrive
from grader.exercises.joints.careful import careful
from grader.exercises.joints.crew import foreman, gymnast, teacher
from grader.exercises.joints.designer import Designer, designer
from grader.exercises.joints.drawing import draw
from grader.exercises.joints.following import trajectory
from grader.exercises.joints.places import arm_of, desk_of, joint_of
from grader.exercises.joints.publishing import seven
from grader.exercises.joints.watching import limits

__all__ = [
    "Designer",
    "arm_of",
    "arrive",
    "careful",
    "designer",
    "desk_of",
    "draw",
    "foreman",
    "gymnast",
    "joint_of",
    "lift",
    "limits",
    "seven",
    "teacher",
    "trajectory",
]
