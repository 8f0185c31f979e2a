"""nbgrader for a student on a hub: assignments are in the home, and the exchange is the student's inbox."""
import os
import pwd
from pathlib import Path

from grader.course_files.work_folder import find_work_folder

c = get_config()  # noqa: F821  (nbgrader provides it)

HERE = Path(__file__).resolve()
course = os.environ.get("ROS2_HUB_COURSE", "")
c.CourseDirectory.course_id = course
inboxes = HERE.parents[3] / "exchange" / "students" / course
c.Exchange.root = str(inboxes / pwd.getpwuid(os.getuid()).pw_name)
c.Exchange.assignment_dir = str(find_work_folder(HERE.parents[2]) / "exercises")
# What colcon makes can be made again.
built = ["build", "install", "log"]
c.CourseDirectory.ignore = [".ipynb_checkpoints", "*.pyc", "__pycache__", "feedback", *built]
