"""Certificates of a class with marks."""
import re
from pathlib import Path

import pytest

from tests.marking.marked_class import (  # noqa: F401
    SCRIPT,
    course,
    mark_by_hand,
    marked,
    marked_template,
    say,
    write_secret,
)

ISSUER = "Chair of Robotics, robotics@example.org"


@pytest.fixture
def page(course, say) -> Path:  # noqa: F811
    """Anna's page, issued in that class."""
    assert say("certificate", "--issuer", ISSUER)[0] == 0
    return course.certificates() / "anna.html"


def number(page: Path) -> str:
    """The number on a page."""
    return re.search(r'data-says="certificate number">([^<]+)<', page.read_text())[1]
