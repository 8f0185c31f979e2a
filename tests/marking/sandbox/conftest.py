"""A sandbox for all tests, and commanded processes."""
from collections.abc import Callable, Iterator

import pytest

from grader.marking.sandbox import Sandbox
from tests.marking.sandbox.commanded import Commanded, sandbox


@pytest.fixture(scope="session")
def usual_sandbox() -> Iterator[Sandbox]:
    """A sandbox with the usual limits."""
    with sandbox() as box:
        yield box


@pytest.fixture
def make_commanded() -> Iterator[Callable[[Sandbox], Commanded]]:
    """Makes commanded processes, and sees to it that none is left."""
    made: list[Commanded] = []

    def make(box: Sandbox) -> Commanded:
        made.append(Commanded(box))
        return made[-1]

    yield make
    for commanded in made:
        commanded.leave()


@pytest.fixture
def commanded(usual_sandbox: Sandbox, make_commanded: Callable[[Sandbox], Commanded]) -> Commanded:
    """One commanded in the usual sandbox."""
    return make_commanded(usual_sandbox)
