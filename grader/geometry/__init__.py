"""Plane geometry and grids for exercises: meters and radians, x forward, y left (REP-103)."""

from grader.geometry.pose import Point, Pose2D
from grader.geometry.walls import rectangle

__all__ = ["Point", "Pose2D", "rectangle"]
