"""A hall in which a robot can't know where it is, and a proper score of what its localization publishes."""

from grader.exercises.localization.kidnapped.hall import carried_hall
from grader.exercises.localization.kidnapped.hall_driver import wandering
from grader.exercises.localization.kidnapped.log_score import log_scores

__all__ = ["carried_hall", "log_scores", "wandering"]
