from collections.abc import Iterator

import pytest

# A failed assertion of the tests that all assignments share shows what differs.
pytest.register_assert_rewrite("tests.exercises.assignment")

from tests.exercises.builds import kept_builds  # noqa: E402


@pytest.fixture(autouse=True, scope="session")
def builds_once() -> Iterator[None]:
    """Equal packages are built once."""
    with kept_builds():
        yield


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """A node's tests are neighbors, so that its runs are made once: see `Evidence`."""
    first: dict[object, int] = {}
    for number, item in enumerate(items):
        first.setdefault(_node(item), number)
    items.sort(key=lambda item: first[_node(item)])


def _node(item: pytest.Item) -> object:
    """What tests of the same node have in common; any other test is alone."""
    asked = getattr(item, "callspec", None)
    if asked is None or "node" not in asked.params or "exercise" not in asked.params:
        return item
    return item.path, asked.params["exercise"], asked.params["node"]
