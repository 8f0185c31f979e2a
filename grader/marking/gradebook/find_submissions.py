"""Finds the submissions of an assignment."""
import difflib
from collections.abc import Collection, Iterable
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.gradebook.course import Course

REMAKE = "run `make exercises`, which makes exercises/ from solutions/ and enters it into the gradebook"


def find_submissions(course: Course, assignment: str, chosen: Collection[str] = ()) -> dict[str, Path]:
    """The folders handed in for an assignment, sorted by student; only those of the chosen, if any.

    Raises CourseError if there is no such assignment, no such student, or no submission.
    """
    names = course.assignments()
    if assignment not in names:
        released = f"{course.release(assignment).parent} has no assignment {assignment}"
        known = f"there are {', '.join(names)}" if names else REMAKE
        raise CourseError(f"{released}: {near(assignment, names) or known}")
    found = course.students(assignment)
    place = course.submitted("STUDENT", assignment)
    for name, problem in course.odd_folders(assignment).items() if not found else ():
        raise CourseError(f"there is one submission of {assignment}, by {name}: {problem}")
    if not found:
        raise CourseError(f"there are no submissions of {assignment}: put the notebooks into {place}")
    for student in chosen:
        if student not in found:
            here = course.submitted(student, assignment)
            if not here.parent.exists() and not near(student, found):
                raise CourseError(f"there is no student {student}: {here.parent} is missing")
            advice = near(student, found) or f"{len(found)} students have handed it in"
            raise CourseError(f"{student} has not handed in {assignment}, {here} is missing: {advice}")
    return {student: folder for student, folder in sorted(found.items()) if not chosen or student in chosen}


def near(name: str, names: Iterable[str]) -> str:
    """A question for the name among `names` that is most like this one; "" if none is."""
    near = difflib.get_close_matches(name, list(names), n=1)
    return f"did you mean {near[0]}?" if near else ""
