"""The exercises of 08_joints, from seven positions to an arm that draws."""

from grader.companions.joint_targets import foreman, gymnast, teacher
from grader.exercises import notebook_names
from grader.worlds.arms import arm_of, desk_of, joint_of

globals().update(notebook_names(__name__))
