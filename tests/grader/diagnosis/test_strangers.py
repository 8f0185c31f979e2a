"""Right programs in other people's styles have neither a fault nor a flaw."""

import pytest

from grader import tell
from sim import run
from tests.students.foreign import CORPUS


def names(programs):
    return "+".join(each.__name__ for each in programs)


@pytest.mark.parametrize("programs", CORPUS, ids=names)
def test_nothing_is_reported_of_a_right_program(programs, capsys):
    recording = run(*programs, world="room", seconds=3, quiet=True)
    tell(recording)
    assert capsys.readouterr().out == f"No error. {recording.ended.detail}\n"


def test_there_are_at_least_forty_of_them():
    assert len({names(programs) for programs in CORPUS}) >= 40
