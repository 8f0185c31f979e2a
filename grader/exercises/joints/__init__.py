"""The exercises of 08_joints, from seven positions to a lift that gets stuck."""

from grader.companions.joint_targets import foreman, gymnast
from grader.exercises import notebook_names
from grader.worlds.arms import arm_of, joint_of

globals().update(notebook_names(__name__))
