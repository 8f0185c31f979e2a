from pathlib import Path

import pytest

from tests.marking.tiny import tiny


@pytest.fixture
def tiny_course(tmp_path: Path) -> Path:
    """A small course of its own for one test, not released yet."""
    return tiny(tmp_path)
