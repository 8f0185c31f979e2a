"""The other process, warm for all tests of a module that leave it well."""

import pytest

from tests.sim.ros.remote.apart import Apart


@pytest.fixture(scope="module")
def apart():
    process = Apart()
    yield process
    process.close()


@pytest.fixture
def lost():
    """One that may be lost."""
    process = Apart()
    yield process
    process.close()
