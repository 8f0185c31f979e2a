"""Nodes in launch files, by the names of upstream's launch_ros, in Python alone."""

from launch_ros import actions, descriptions, parameter_descriptions, substitutions

__all__ = ["actions", "descriptions", "parameter_descriptions", "substitutions"]
