"""Refuses an autograder for an assignment with variants where it can't draw them."""

from pathlib import Path

import nbformat

from grader.marking.errors import NoVariants
from grader.marking.judge.personal_release import has_variants

NOT_HERE = (
    "{} has variants, which follow from the class's secret and the student's name: of the platforms only "
    "gradescope has both, without --public-worlds"
)


def require_known_variants(course: Path, assignment: str, platform: str, has_secret: bool) -> None:
    """Raise NoVariants if the assignment has variants, and the autograder can't draw them."""
    paths = (course / "exercises" / assignment).glob("*.ipynb")
    can_draw = platform == "gradescope" and has_secret
    if not can_draw and has_variants(nbformat.read(path, 4) for path in paths):
        raise NoVariants(NOT_HERE.format(assignment))
