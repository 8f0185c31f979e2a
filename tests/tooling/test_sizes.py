"""Modules and functions that fit into a head."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULE, FUNCTION = 250, 50  # lines; most functions have under 35


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
