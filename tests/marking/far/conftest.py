import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.marking.plan import Task
from tests.marking.far.cluster import Cluster
from tests.marking.pool.assignment import hand_in, release


@pytest.fixture
def cluster(tmp_path) -> Iterator[Cluster]:
    """A scheduler of its own for one test, without workers."""
    cluster = Cluster(tmp_path / "cluster")
    yield cluster
    cluster.close()


@pytest.fixture(scope="package")
def shared(tmp_path_factory) -> Iterator[Cluster]:
    """A scheduler for the tests that leave it as it is; each says how many workers it needs."""
    cluster = Cluster(tmp_path_factory.mktemp("shared") / "cluster")
    yield cluster
    cluster.close()


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
