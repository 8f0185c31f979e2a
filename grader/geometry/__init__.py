"""Plane geometry and grids for exercises: metres and radians, x forward, y left (REP-103)."""

from grader.geometry.pose import Point, Pose2D

__all__ = ["Point", "Pose2D"]
