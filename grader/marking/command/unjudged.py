"""Results in which no test cell was judged: they are entered only if others show that judging works here."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from grader.marking.errors import CourseError
from grader.marking.result import Result


@dataclass
class Unjudged:
    """The results of a run in which no test cell was judged.

    broken: why a student's submission couldn't be judged, though it is not the student's fault: it is never
    entered. held: results that wait until one of the class is judged.
    """

    broken: dict[str, str] = field(default_factory=dict)
    held: dict[str, Result] = field(default_factory=dict)

    def add(self, result: Result) -> None:
        """Store a result that is not to be entered now."""
        if result.verdict == "broken":
            self.broken[result.student] = result.reason
        else:
            self.held[result.student] = result

    def release(self, entered: Collection[str], chosen: Collection[str]) -> Iterator[Result]:
        """Yield what may be entered at the end of a run. Raises CourseError if nothing at all was judged.

        entered: whose results were entered. chosen: the students who were named, if any: the instructor knows
        about these.
        """
        reasons = self.broken | {student: result.why_not_judged for student, result in self.held.items()}
        if reasons and not entered and (self.broken or not chosen):
            student, why = min(reasons.items())
            many = f"none of the {len(reasons)} submissions could"
            count = many if len(reasons) > 1 else "the submission could not"
            advice = f"; if it is the student's own fault, add `--student {student}`"
            raise CourseError(
                f"{count} be judged, so nothing was entered and no page made "
                f"({student}: {why.strip().rstrip('.')})" + (advice if not self.broken else "")
            )
        yield from self.held.values()
