"""The docstring of every public function and class begins with a verb or a noun."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("sim", "grader", "jupyter/wheel/ros2_course", "ros_packages/python")
# Interrogatives, conjunctions and pronouns: a docstring that begins with one lacks its verb or its noun.
LACKING = {
    *("how", "what", "when", "where", "whether", "which", "who", "whose", "why"),
    *("as", "because", "if", "so", "until", "while"),
    *("it", "that", "they", "those"),
}


def documented(source: str) -> list[tuple[int, str]]:
    """The line and first word of each public docstring; that of a check is the student's line."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) or node.name[0] == "_":
            continue
        is_check = any(".check(" in ast.unparse(decorator) for decorator in node.decorator_list)
        words = (ast.get_docstring(node) or "").split()
        if words and not is_check:
            found.append((node.lineno, words[0].strip("`*“”\"'.,:;()")))
    return found


@pytest.mark.parametrize("package", PACKAGES)
def test_a_docstring_begins_with_a_verb_or_a_noun(package):
    words = [
        (f"{path.relative_to(ROOT)}:{line}", word)
        for path in sorted((ROOT / package).rglob("*.py"))
        for line, word in documented(path.read_text("utf-8"))
    ]
    assert len(words) > 1
    assert [f"{place}: {word} ..." for place, word in words if word.lower() in LACKING] == []


@pytest.mark.parametrize(
    ("source", "word"),
    [
        ('def due():\n    """Whether it is due."""', "Whether"),
        ('class Pose:\n    """Where the robot is."""', "Where"),
        ('class Bag:\n    def now(self):\n        """As `System`."""', "As"),
        ('def due():\n    """Return whether it is due."""', "Return"),
    ],
)
def test_the_first_word_of_a_docstring_is_found(source, word):
    assert [found for _, found in documented(source)] == [word]


@pytest.mark.parametrize(
    "source",
    [
        'def _due():\n    """Whether it is due."""',
        '@heart.check(5)\ndef beats(run):\n    """It beats twice a second."""',
        "def due():\n    pass",
    ],
)
def test_private_names_and_the_lines_of_checks_are_free(source):
    assert documented(source) == []
