"""The exercises of 08_joints, from seven positions to an arm that draws."""

from grader.companions.figure import Designer, designer
from grader.companions.joint_targets import foreman, gymnast, teacher
from grader.companions.lift import lift
from grader.companions.pan_tilt_driver import pan_tilt_driver
from grader.exercises.joints.arrive import arrive
from grader.exercises.joints.careful import careful
from grader.exercises.joints.degrees import degrees
from grader.exercises.joints.describe import describe
from grader.exercises.joints.draw import draw
from grader.exercises.joints.limits import limits
from grader.exercises.joints.seven import seven
from grader.exercises.joints.trajectory import trajectory
from grader.worlds.arms import arm_of, desk_of, joint_of
