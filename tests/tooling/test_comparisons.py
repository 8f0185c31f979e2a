"""Numbers from a student's program are compared by "is near", which is false for NaN, not by "isn't far"."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

GRADER = Path(__file__).parents[2] / "grader"
FOLDERS = ("checks", "exercises", "responses", "companions")
GAPS = {"abs", "fabs", "dist", "hypot", "norm"}


def measures_a_gap(node: ast.expr) -> bool:
    calls = (part.func for part in ast.walk(node) if isinstance(part, ast.Call))
    return any(getattr(call, "id", getattr(call, "attr", "")) in GAPS for call in calls)


def far_comparisons(source: str) -> Iterator[str]:
    """The comparisons that ask whether a gap is large, and have no upper end for it, such as abs(x) > 1."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            pairs = [
                (one, other) if isinstance(operation, ast.Gt | ast.GtE) else (other, one)
                for one, operation, other in zip(sides, node.ops, sides[1:], strict=False)
                if isinstance(operation, ast.Gt | ast.GtE | ast.Lt | ast.LtE)
            ]
            limited = {id(smaller) for _, smaller in pairs}
            if any(measures_a_gap(larger) and id(larger) not in limited for larger, _ in pairs):
                yield f"line {node.lineno}: {ast.unparse(node)}"


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_check_asks_whether_a_number_is_far_from_the_right_one(folder):
    """Write `not is_near(x, wanted, tolerance)` of grader/geometry/near.py, or limits on both sides."""
    sources = {
        path.relative_to(GRADER).as_posix(): path.read_text(encoding="utf-8")
        for path in (GRADER / folder).rglob("*.py")
    }
    found = {path: list(far_comparisons(source)) for path, source in sources.items()}
    assert {path: lines for path, lines in found.items() if lines} == {}


def test_a_comparison_that_nan_passes_is_found():
    far = ("abs(x - y) > 1", "1 <= abs(x)", "max(math.dist(a, b) for b in c) >= 1", "np.linalg.norm(x) > 1")
    for source in far:
        assert list(far_comparisons(f"a = 0\n{source}")) == [f"line 2: {ast.unparse(ast.parse(source))}"]
    for source in ("abs(x) <= 1", "1 > abs(x)", "1 < abs(x) < math.inf", "not is_near(x, y, 1)", "x > 1"):
        assert list(far_comparisons(source)) == []
