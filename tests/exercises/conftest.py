from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

# A failed assertion of the tests that all assignments share shows what differs.
pytest.register_assert_rewrite("tests.exercises.assignment")

from tests.exercises.builds import kept_builds  # noqa: E402


@pytest.fixture(autouse=True, scope="session")
def builds_once() -> Iterator[None]:
    """Equal packages are built once."""
    with kept_builds():
        yield


def pytest_addoption(parser: pytest.Parser) -> None:
    """`python -m tests.exercises` asks for one exercise."""
    parser.addoption("--exercise", metavar="TOPIC/NAME", help="only the tests that concern this exercise")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """A node's tests are neighbors, so that its runs are made once: see `Evidence`."""
    if place := config.getoption("--exercise"):
        items[:] = [item for item in items if concerns(item, *place.split("/"))]
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


def concerns(item: pytest.Item, topic: str, name: str) -> bool:
    """Whether a test tries an exercise: it is in its folder, or has it, its topic or lesson as argument."""
    asked: dict[str, Any] = item.callspec.params if hasattr(item, "callspec") else {}
    if item.path.name == f"test_{topic}.py":
        return item.function.__qualname__.startswith("Assignment.") and asked.get("exercise", name) == name
    if "assignment" in asked:
        return (asked["assignment"].topic(), asked["name"]) == (topic, name)
    if "lesson" in asked:
        return f'lesson = "{asked["lesson"]}"' in _rules(topic, name)
    is_asked = f"{topic}/{name}" in asked.values() or topic == asked.get("topic") or name == asked.get("name")
    return is_asked or item.path.parent.parts[-2:] == (topic, name) or item.path.parent.name == "tooling"


def _rules(topic: str, name: str) -> str:
    path = Path(__file__).with_name(topic) / name / "rules.toml"
    return path.read_text(encoding="utf-8") if path.exists() else ""
