"""Judges what students' nodes do: exercises, checks and scores."""

from grader.catalogue import grade
from grader.checks.check import Missed, check
from grader.exercise import Exercise, Scenario
from grader.score import Score

__all__ = ["Exercise", "Missed", "Scenario", "Score", "check", "grade"]
