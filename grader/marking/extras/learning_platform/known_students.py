"""The students of a class, with the numbers that a platform gave them."""
from collections import defaultdict

from grader.marking.extras.learning_platform.platform_users import KnownStudent
from grader.marking.gradebook.book import Book, GradebookStudent
from grader.marking.gradebook.collected_uploads import read_collected
from grader.marking.gradebook.course import Course


def known_students(course: Course, assignment: str) -> list[KnownStudent]:
    """Everyone in the gradebook or with a submission, with the platform's numbers."""
    with Book(course) as book:
        about = {each.student: each for each in book.students()}
    numbers: dict[str, set[str]] = defaultdict(set)
    for name in course.assignments():
        for student, each in read_collected(course, name).items():
            if each.lasting or name == assignment:
                numbers[student].add(each.number)
    everyone = sorted({*about, *course.students(assignment), *numbers})
    known = {student: about.get(student) or GradebookStudent(student, "", "", "") for student in everyone}
    return [
        KnownStudent(student, each.first, each.last, each.mail, frozenset(numbers[student]))
        for student, each in known.items()
    ]
