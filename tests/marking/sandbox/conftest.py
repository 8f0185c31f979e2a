"""A cage for all tests, and prisoners."""
from collections.abc import Callable, Iterator

import pytest

from grader.marking.sandbox import Sandbox
from tests.marking.sandbox.prison import Prisoner, sandbox


@pytest.fixture(scope="session")
def cage() -> Iterator[Sandbox]:
    """A sandbox with the usual limits."""
    with sandbox() as box:
        yield box


@pytest.fixture
def prisoners() -> Iterator[Callable[[Sandbox], Prisoner]]:
    """Makes prisoners, and sees to it that none is left."""
    made: list[Prisoner] = []

    def make(box: Sandbox) -> Prisoner:
        made.append(Prisoner(box))
        return made[-1]

    yield make
    for prisoner in made:
        prisoner.leave()


@pytest.fixture
def prisoner(cage: Sandbox, prisoners: Callable[[Sandbox], Prisoner]) -> Prisoner:
    """One prisoner in the usual cage."""
    return prisoners(cage)
