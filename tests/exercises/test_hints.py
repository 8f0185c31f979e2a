"""Every hint of an exercise has a wrong node that gets it, or a test that shows it."""

import ast
import functools
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.catalog import exercises

ROOT = Path(__file__).parents[2]
EXERCISES = ROOT / "grader/exercises"
LEAST = 5  # words: a shorter text is a name, a topic or a part of a sentence
FOR_AUTHORS = (
    *("ValueError", "no_data", "from_course", "requests_from_course"),
    *("Stimuli", "Exercise", "compile", "from_data"),
)
TOPICS = sorted(path.name for path in EXERCISES.iterdir() if path.is_dir() and path.name[0] != "_")


def sentences(source: str) -> Iterator[str]:
    """The texts of a module that a student may read: all but docstrings, and those with a few words only."""
    tree = ast.parse(source)
    unread = {id(part) for node in ast.walk(tree) if _is_unread(node) for part in ast.walk(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in unread:
            yield from [node.value] if len(node.value.split()) >= LEAST else []


def _is_unread(node: ast.AST) -> bool:
    """Whether a node is a docstring, or a call whose texts are for the course's authors."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant)
    called = node.func if isinstance(node, ast.Call) else None
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
    return name in FOR_AUTHORS


@functools.cache
def shown_somewhere() -> str:
    """Every score page, and every test of the grader, with one space between words."""
    files = [*(ROOT / "tests/exercises").rglob("*.txt"), *(ROOT / "tests/exercises").rglob("test_*.py")]
    files += (ROOT / "tests/grader").rglob("*.py")
    return " ".join(" ".join(file.read_text(encoding="utf-8").split()) for file in files)


def unseen(text: str, shown: str) -> list[str]:
    """The parts of a text, between {placeholders}, that are shown nowhere."""
    texts = re.split(r"\{[^{}]*\}", text.replace("{{", "{").replace("}}", "}"))
    parts = [" ".join(part.split()) for part in texts]
    return [part for part in parts if len(part.split()) >= LEAST and part not in shown]


def test_a_sentence_is_found_by_its_words():
    source = '"""Not a hint, only a docstring."""\nX = ["Turn {x:g} times, not one more than that.", "/a"]'
    (found,) = sentences(source)
    assert unseen(found, "Turn 3 times, not one more than that.") == []
    assert unseen(found, "Turn 3 times") == ["times, not one more than that."]


@pytest.mark.parametrize("topic", TOPICS)
def test_every_hint_has_a_wrong_node_that_gets_it(topic):
    shown = shown_somewhere()
    hidden = {
        f"{path.relative_to(ROOT)}: {part}"
        for path in sorted([*EXERCISES.glob(f"{topic}/*.py"), *EXERCISES.glob(f"{topic}/*/__init__.py")])
        for text in sentences(path.read_text(encoding="utf-8"))
        for part in unseen(text, shown)
    }
    assert hidden == set()


@pytest.mark.parametrize("name", sorted(exercises()))
def test_every_row_of_a_table_of_hints_is_shown(name):
    shown = shown_somewhere()
    checks = exercises()[name].checks
    rows = [text for check in checks for text in check.hints]
    guesses = [check.guess for check in checks]
    rows += [text for guess in guesses for text in ([guess] if isinstance(guess, str) else guess)]
    assert [part for text in rows for part in unseen(text, shown)] == []
