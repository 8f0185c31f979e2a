"""Modules and functions that fit into a head, and rooms that grow by decision."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULE, FUNCTION = 250, 50  # lines; most functions have under 35
LEFT_OUT = {"__pycache__", "node_modules"}
# Lines of Python that a room may have. Who needs more raises the number, and says why in the commit.
BUDGETS = {
    "sim": 35_400,
    "sim/ros": 17_780,
    "sim/ros2": 5_080,
    "sim/view": 3_950,
    "sim/world": 4_300,
    "grader": 54_050,
    "grader/checks": 2_950,
    "grader/companions": 2_450,
    "grader/diagnosis": 4_500,
    "grader/exercises": 21_800,
    "grader/marking": 17_500,
    "ros_packages": 11_100,
    "tests": 118_900,
    "tests/exercises": 33_900,
    "tests/grader": 10_700,
    "tests/marking": 18_250,
    "tests/ros_packages": 3_450,
    "tests/sim": 25_880,
    "tests/students": 14_000,
    "tests/tooling": 4_950,
    "tests/bench": 1_850,
}


def too_long(source: str) -> list[str]:
    """The source and each function in it that has more lines than is allowed."""
    found = ["the module"] if source.count("\n") > MODULE else []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            found += [node.name] if node.end_lineno - node.lineno >= FUNCTION else []
    return found


@pytest.mark.parametrize("package", ["sim", "grader", "ros_packages"])
def test_no_module_and_no_function_is_long(package):
    files = sorted((ROOT / package).rglob("*.py"))
    sizes = {file.relative_to(ROOT).as_posix(): too_long(file.read_text(encoding="utf-8")) for file in files}
    assert {file: found for file, found in sizes.items() if found} == {}


def test_what_is_too_long_is_found():
    body = "    pass\n" * (FUNCTION - 1)
    assert too_long(f"def fits():\n{body}") == []
    assert too_long(f"class A:\n  async def long(self):\n    pass\n{body}") == ["long"]
    assert too_long("x = 1\n" * MODULE) == []
    assert too_long("x = 1\n" * (MODULE + 1)) == ["the module"]


@pytest.mark.parametrize("room", BUDGETS)
def test_a_room_keeps_to_its_budget(room):
    files = [file for file in sorted((ROOT / room).rglob("*.py")) if not LEFT_OUT & set(file.parts)]
    lines = sum(file.read_text(encoding="utf-8").count("\n") for file in files)
    assert lines <= BUDGETS[room], f"{room} has {lines} lines: remove some, or raise its budget and say why"
