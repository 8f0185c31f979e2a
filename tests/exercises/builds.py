"""Builds of students' packages: equal sources are built once, and kept as recordings are."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from grader.workspace import building
from grader.workspace.building import Built
from grader.workspace.sources import Sources
from tests.exercises.evidence import Evidence

NOT_READ = "/session.txt"  # no build reads what is typed in terminals
DECIDES = "grader/workspace/building.py", "grader/workspace/sources.py", "requirements.lock"


@contextmanager
def kept_builds() -> Iterator[None]:
    """Here a package is built where no one has built the same before."""
    evidence, build = Evidence("builds", *DECIDES), building.build

    def kept_or_built(sources: Sources) -> Built:
        read = {path: data for path, data in sources.items() if not path.endswith(NOT_READ)}
        whole = repr(sorted(read.items())).encode()
        return evidence.get(hashlib.sha256(whole).hexdigest()[:16], lambda: build(sources))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(building, "build", kept_or_built)
        yield
