#!/bin/sh
# PrairieLearn runs this as root for each submission.
set -eu
cd /autograder/source
exec /opt/ros2-course/.venv/bin/python -P -m grader.marking.extras.platforms.run prairielearn
