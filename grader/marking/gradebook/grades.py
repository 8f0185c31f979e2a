"""`nbgrader export`: all points as class/grades.csv, of the assignments with submissions."""
import csv
from pathlib import Path
from typing import Any

from nbgrader.api import Gradebook, MissingEntry
from nbgrader.plugins import CsvExportPlugin

from grader.marking.spreadsheet import inert

FILE = Path("class", "grades.csv")  # git ignores this folder
ABOUT = ["assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email"]
FIELDS = [*ABOUT, *["raw_score", "late_submission_penalty", "score", "max_score"]]


class Grades(CsvExportPlugin):  # type: ignore[misc]
    """nbgrader's exporter with its columns, quoted, and without assignments that have no submissions.

    Nbgrader's own gives 0 to all in such assignments, and a comma in a name shifts the columns.
    """

    def export(self, gradebook: Gradebook) -> None:
        """Write the file; `--to`, `--assignment` and `--student` as nbgrader's."""
        with open(self.to or FILE, "w", encoding="utf-8", newline="") as file:
            table = csv.DictWriter(file, FIELDS, lineterminator="\n")
            table.writeheader()
            for assignment in gradebook.assignments:
                if assignment.name in self.assignment or (not self.assignment and assignment.num_submissions):
                    for student in gradebook.students:
                        if not self.student or student.id in map(str, self.student):
                            row = _row(gradebook, assignment, student)
                            table.writerow({key: inert(value) for key, value in row.items()})


def _row(gradebook: Gradebook, assignment: Any, student: Any) -> dict[str, object]:
    """A student without a submission has 0 points, as in nbgrader."""
    row = {
        "assignment": assignment.name,
        "duedate": assignment.duedate,
        "student_id": student.id,
        "last_name": student.last_name,
        "first_name": student.first_name,
        "email": student.email,
        "max_score": assignment.max_score,
        **dict.fromkeys(("raw_score", "late_submission_penalty", "score"), 0.0),
    }
    try:
        found = gradebook.find_submission(assignment.name, student.id)
    except MissingEntry:
        return row
    penalty = found.late_submission_penalty
    score = max(0.0, found.score - (penalty or 0.0))
    rest = {"raw_score": found.score, "late_submission_penalty": penalty, "score": score}
    return row | {"timestamp": found.timestamp, **rest}
