from collections.abc import Iterator

import pytest

from tests.marking.extras.dask_cluster.cluster import Cluster


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
