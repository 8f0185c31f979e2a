import os
from pathlib import Path

import pytest

from grader.marking.plan import Task
from tests.marking.pool.assignment import hand_in, release
from tests.marking.tiny import tiny


@pytest.fixture
def tiny_course(tmp_path: Path) -> Path:
    """A small course of its own for one test, not released yet."""
    return tiny(tmp_path)


@pytest.fixture
def gate(tmp_path) -> Path:
    """A pipe at which a cell says that it is there, and waits for somebody who reads that."""
    os.mkfifo(tmp_path / "gate")
    return tmp_path / "gate"


@pytest.fixture
def waiting(tmp_path, gate) -> Task:
    """A submission whose cell waits at the gate."""
    cell = f"open({str(gate)!r}, 'w').write('x')"
    return hand_in(tmp_path / "ann", release(tmp_path / "02_two"), {"greeting-see": cell})
