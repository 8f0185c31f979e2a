"""How late a submission was, and what that costs."""
import math
from dataclasses import dataclass
from datetime import UTC, datetime

from grader.marking.errors import CourseError

FORM = "2026-12-01 18:00"
DAY_S = 86400.0


@dataclass(frozen=True)
class Lateness:
    """The times that decide how late a submission was. due, handed_in: UTC, without a zone."""

    due: datetime
    handed_in: datetime

    @property
    def seconds(self) -> float:
        """The seconds after the due date; 0 if it was in time."""
        return max(0.0, (self.handed_in - self.due).total_seconds())


def late_penalty(points: float, seconds_late: float, percent_per_day: float) -> float:
    """The points that are lost of `points`: a share for each day that has begun."""
    days = math.ceil(seconds_late / DAY_S)
    return round(points * min(1.0, days * percent_per_day / 100), 2)


def parse_local(text: str) -> datetime:
    """A moment in local time, or with an offset, as UTC without a zone. Raises CourseError."""
    try:
        moment = datetime.fromisoformat(text.strip())
    except ValueError:
        moment = None
    if moment is None or len(text.strip()) <= len("2026-12-01"):
        raise CourseError(f"expected day and time such as {FORM}, saw {text!r}")
    return moment.astimezone(UTC).replace(tzinfo=None)
