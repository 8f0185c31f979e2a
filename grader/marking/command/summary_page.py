"""The summary of a class as one HTML page: no scripts, no external resources, everything escaped."""
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from urllib.parse import quote

from grader.marking.command.summary import Summary
from grader.marking.gradebook.course import Course
from grader.marking.page_templates import template_environment


def as_page(summary: Summary, links: Mapping[str, str] | None = None) -> str:
    """The whole page. links: the address of each student's own page, if there is one."""
    return _pages.get_template("summary.html").render(summary=summary, links=links or {}).lstrip()


def page_links(course: Course, assignment: str, students: Iterable[str], page: Path) -> dict[str, str]:
    """The addresses of the students' first pages, relative to `page`."""
    found = {student: sorted(course.feedback(student, assignment).glob("*.html")) for student in students}
    return {
        student: quote(os.path.relpath(pages[0], page.absolute().parent))
        for student, pages in found.items()
        if pages
    }


_pages = template_environment(Path(__file__).parent)
_pages.filters["number"] = "{:g}".format
