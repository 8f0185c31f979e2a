"""The exercises of 08b_drawing, from the description of a camera to an arm that draws."""

from grader.companions.joint_targets import teacher
from grader.exercises import notebook_names
from grader.worlds.arms import arm_of, desk_of

globals().update(notebook_names(__name__))
