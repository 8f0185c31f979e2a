"""Right programs in other people's styles have neither a fault nor a flaw."""

import pytest

from grader.diagnosis import find_fault, find_flaw
from sim import run
from tests.students.strangers import CORPUS


@pytest.mark.parametrize("students", CORPUS, ids=lambda students: "+".join(each.__name__ for each in students))
def test_a_right_program_is_left_alone(students):
    recording = run(*students, seconds=4, quiet=True)
    assert find_fault(recording) is None
    assert find_flaw(recording) == ""
