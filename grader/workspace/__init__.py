"""A student's workspace: its sources as data, what colcon builds of them, and their programs."""
