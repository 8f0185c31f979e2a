"""A student's colcon workspace: its sources as data, the build by colcon, and the installed programs."""
