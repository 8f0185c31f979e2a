"""What being late costs: a share of the points for each day that has begun."""
from nbgrader.plugins import LateSubmissionPlugin
from traitlets import Float

from grader.marking.lateness import late_penalty


class LateDays(LateSubmissionPlugin):  # type: ignore[misc]
    """A plugin of nbgrader's `AssignLatePenalties`."""

    percent_per_day = Float(0.0, min=0.0, max=100.0, help="percent of the points earned").tag(config=True)

    def late_submission_penalty(
        self, student_id: str, score: float, total_seconds_late: float
    ) -> float | None:
        """The points that are lost; what nbgrader's plugin gives if no percentage is set."""
        if not self.percent_per_day:
            usual: float | None = super().late_submission_penalty(student_id, score, total_seconds_late)
            return usual
        return late_penalty(score, total_seconds_late, self.percent_per_day)
