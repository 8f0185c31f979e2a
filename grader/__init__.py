"""Judges what students' nodes do: exercises, checks and scores."""

from grader.catalog import grade
from grader.checks.check import Missed, check
from grader.course_files.course_map import course_map
from grader.exercise import Exercise
from grader.scenario import Scenario
from grader.score import Score
from grader.tell import tell

__all__ = ["Exercise", "Missed", "Scenario", "Score", "check", "course_map", "grade", "tell"]
