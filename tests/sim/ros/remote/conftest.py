"""The follower process, shared by the tests of a module."""

import pytest

from tests.sim.ros.remote.follower_process import FollowerProcess


@pytest.fixture(scope="module")
def follower():
    process = FollowerProcess()
    yield process
    process.close()


@pytest.fixture
def lost():
    """A follower process of its own, for tests that end it."""
    process = FollowerProcess()
    yield process
    process.close()
