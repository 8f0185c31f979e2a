"""A class with marks, and a receipt of anna's."""
from pathlib import Path
from types import SimpleNamespace

import pytest

from grader.seeds import private_seed
from tests.marking.marked_class import course, marked_template, say  # noqa: F401

ISSUER = "Chair of Robotics, robotics@example.org"


@pytest.fixture(autouse=True)
def exercises(monkeypatch) -> None:
    """The test class has made-up exercises, with two runs each."""

    def find(full_name: str) -> SimpleNamespace:
        name = full_name.rpartition(".")[2]
        runs = lambda secret: [(None, private_seed(secret, name, index)) for index in range(2)]  # noqa: E731
        return SimpleNamespace(name=name, runs=runs)

    monkeypatch.setattr("grader.marking.extras.receipts.issue.find_exercise", find)


@pytest.fixture
def issue(course, say):  # noqa: F811
    """Issues the receipts of the class."""
    return lambda *options: say("receipts", "--issuer", ISSUER, *options)


@pytest.fixture
def receipt(course, issue) -> Path:  # noqa: F811
    """Anna's receipt, issued in that class."""
    assert issue()[0] == 0
    return course.receipts() / "anna" / "01_class.json"
