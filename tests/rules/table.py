"""The rules that the lessons state, and what looks for each of them.

A rule that a check looks for is in the folder of the exercise, tests/exercises/TOPIC/EXERCISE/rules.toml; one
that no check looks for is in the file of its lesson, tests/rules/NN_TOPIC.toml. A row, [[rule]], has

    rule        the rule, in one sentence
    lesson      in an exercise's folder: the lesson that states it, such as "02_topics"
    in.CELL     where the lesson states it: the id of a cell, and words of one sentence in it, or a list; of a
                cell in another notebook than lesson.ipynb, such as driving.ipynb: in.driving.CELL
    check       the exercise's check that looks for it: the name of its function; a program that fails with an
                error loses its points at "runs", a package at "is_built", and without the types that it uses
                at "has_types"
    wrong       nodes on the exercise's score page that break the rule, and lose points at this check
    right       nodes there that keep it, and earn everything
    program.CELL  the wrong node that is the program of this cell, adapted by renaming: see programs.py
    technique   where the rule recommends a way to write it: a pattern that the right nodes' sources have
    unchecked   in a lesson's file, in place of check, wrong and right: "CATEGORY: reason"

Without a check a technique is one that a right node of any exercise has. In the file of a lesson the table
[no_rule] has, by cell, words of sentences that state no rule, though they have one of the words that rules
mostly have; [no_node], by cell, why no node is adapted from its program.
"""

from __future__ import annotations

import ast
import functools
import json
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from grader.course_files.course_notebooks import FIRST, course_order
from grader.diagnosis.fault import Fault
from tests.exercises.score_tables import page, with_pages
from tests.exercises.seeds import exercise_of, right_nodes

ROOT = Path(__file__).parents[2]
TABLES = Path(__file__).parent
LESSONS = tuple(sorted(path.parent.name for path in ROOT.glob("course/*/lesson.ipynb")))

# Why a rule has no check.
CATEGORIES = {
    "fact": "explains something: no program keeps or breaks it",
    "notebook": "is about the course's own tools, such as `run` and its pictures",
    "judgment": "is about designing, reading or looking for faults: it leaves no trace in a run",
    "elsewhere": "is about hardware, terminals, networks or real time, which graded runs don't have",
    "no exercise": "could be seen in a run, but no exercise asks for it",
    "not yet": "will have a check soon",
}
SELF_EVIDENT = ("fact", "notebook")  # categories that need no further reason
ERRORS = {
    "runs": Fault.sentence,
    "is_built": "Your package is built.",
    "has_types": "The types that your package uses are built.",
}


@dataclass(frozen=True)
class Rule:
    """A row: a rule, where the lesson states it (cell, words), and what looks for it, or why nothing does."""

    rule: str
    quotes: tuple[tuple[str, str], ...]
    check: str = ""
    wrong: tuple[str, ...] = ()
    right: tuple[str, ...] = ()
    technique: str = ""
    unchecked: str = ""
    programs: tuple[tuple[str, str], ...] = ()

    @property
    def category(self) -> str:
        """Why it has no check, in one of CATEGORIES; "" where it has one."""
        return self.unchecked.partition(":")[0]

    @property
    def reason(self) -> str:
        """Why it has no check, in a sentence; may be empty."""
        return self.unchecked.partition(":")[2].strip()


@dataclass(frozen=True)
class Table:
    """The rules of a lesson, and the quotes (cell, words) of sentences that state none."""

    rules: tuple[Rule, ...]
    no_rule: tuple[tuple[str, str], ...] = ()
    no_node: tuple[tuple[str, str], ...] = ()


def read_table(text: str) -> Table:
    """The table that a TOML file describes. Raises TypeError for a key that rows don't have."""
    data = tomllib.loads(text)
    rules = [_rule(row) for row in data.pop("rule", [])]
    more = {key: _quotes(data.pop(key, {})) for key in ("no_rule", "no_node")}
    return Table(tuple(rules), **more, **data)


def _rule(row: dict[str, Any]) -> Rule:
    lists = {key: _names(row.pop(key)) for key in ("wrong", "right") if key in row}
    return Rule(quotes=_quotes(row.pop("in")), programs=_quotes(row.pop("program", {})), **lists, **row)


def _names(value: str | list[str]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def _quotes(cells: dict[str, Any], notebook: str = "") -> tuple[tuple[str, str], ...]:
    """Pairs (cell, words). cells: by id; or by the name of a notebook, and by id inside it."""
    found: list[tuple[str, str]] = []
    for cell, value in cells.items():
        inside = isinstance(value, dict)
        found += _quotes(value, f"{cell}.") if inside else ((notebook + cell, each) for each in _names(value))
    return tuple(found)


@functools.cache
def table_of(lesson: str) -> Table:
    """The table of a lesson, such as "01_nodes", with its rows in the folders of exercises, in its order."""
    table = read_table((TABLES / f"{lesson}.toml").read_text(encoding="utf-8"))
    cells = cells_of(lesson)
    places = {name: place for place, name in enumerate(cells)}

    def place(rule: Rule) -> tuple[int, int]:
        cell, words = rule.quotes[0]
        return places.get(cell, -1), one_line(cells[cell].source).find(words) if cell in cells else -1

    return replace(table, rules=tuple(sorted([*table.rules, *exercise_rules().get(lesson, [])], key=place)))


@functools.cache
def exercise_rules() -> dict[str, list[Rule]]:
    """The rows in the folders of exercises, by lesson. Their checks are named "TOPIC/EXERCISE: FUNCTION"."""
    found: dict[str, list[Rule]] = {}
    for path in sorted(ROOT.glob("tests/exercises/*/*/rules.toml")):
        for row in tomllib.loads(path.read_text(encoding="utf-8"))["rule"]:
            check = f"{path.parts[-3]}/{path.parts[-2]}: {row['check']}"
            found.setdefault(row.pop("lesson"), []).append(_rule(row | {"check": check}))
    return found


@dataclass(frozen=True)
class Cell:
    """A cell of a lesson."""

    kind: str  # "markdown" or "code"
    source: str


def cells_of(lesson: str) -> dict[str, Cell]:
    """The cells of a lesson by their ids, in order; those of driving.ipynb as driving.ID."""
    found = {}
    for path in sorted((ROOT / "course" / lesson).glob("*.ipynb"), key=course_order):
        notebook = "" if path.name == FIRST else f"{path.stem}."
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            found[notebook + cell["id"]] = Cell(cell["cell_type"], "".join(cell["source"]))
    return found


def problems(table: Table, cells: dict[str, Cell]) -> Iterator[str]:
    """What is wrong with a table, row by row, as sentences."""
    for cell, words in [*(quote for rule in table.rules for quote in rule.quotes), *table.no_rule]:
        if cell not in cells:
            yield f"“{words}”: the lesson has no cell {cell}"
        elif words not in one_line(cells[cell].source):
            yield f"“{words}”: the cell {cell} doesn't say so"
    for rule in table.rules:
        found = _unchecked_problems(rule) if rule.unchecked else _checked_problems(rule)
        yield from (f"{rule.rule} {problem}" for problem in found)


def _unchecked_problems(rule: Rule) -> Iterator[str]:
    if rule.category not in CATEGORIES:
        yield f"“{rule.category}” is none of the reasons: {', '.join(CATEGORIES)}"
    elif not rule.reason and rule.category not in SELF_EVIDENT:
        yield f"Why is it “{rule.category}”? Write a reason behind a colon"
    if rule.check or rule.wrong or rule.right:
        yield "It has a check or nodes, and says that it is unchecked"
    if rule.technique and not users(rule.technique):
        yield f"No right node of any exercise has anything like “{rule.technique}”"


def _checked_problems(rule: Rule) -> Iterator[str]:
    found = re.fullmatch(r"(\w+)/(\w+): (\w+)", rule.check)
    if found is None:
        yield f"Expected a check such as “nodes/heart: beats”, or `unchecked`, saw “{rule.check}”"
        return
    topic, exercise, function = found.groups()
    sentence = _sentence(topic, exercise, function)
    if not sentence:
        yield f"There is no check {rule.check}"
        return
    pages, right = page(topic, exercise), right_nodes(topic, exercise)
    yield from (f"It has no {kind} node" for kind in ("wrong", "right") if not getattr(rule, kind))
    yield from (f"The page {topic}/{exercise} has no {node}" for node in _missing(rule, pages))
    for node in rule.wrong:
        if node in pages and f"- {sentence}" not in pages[node].splitlines():
            yield f"{node} loses nothing at “{sentence}”"
    for node in (node for node in rule.right if node in pages):
        if node not in right:
            yield f"{node} doesn't earn everything"
        if not re.search(rule.technique, source_of(topic, exercise, node)):
            yield f"The source of {node} has nothing like “{rule.technique}”"


def _missing(rule: Rule, pages: dict[str, str]) -> list[str]:
    return [node for node in (*rule.wrong, *rule.right) if node not in pages]


def _sentence(topic: str, exercise: str, function: str) -> str:
    """The sentence of a check, as students and score pages have it; "" if there is no such check."""
    try:
        checks = exercise_of(topic, exercise).checks
    except (ImportError, AttributeError):
        return ""
    return {check.name: check.sentence for check in checks}.get(function) or ERRORS.get(function, "")


@functools.cache
def users(technique: str) -> tuple[str, ...]:
    """The right nodes of all exercises whose source has this pattern, as "TOPIC/EXERCISE: NODE"."""
    return tuple(
        f"{topic}/{exercise}: {node}"
        for topic, exercise in with_pages()
        for node in right_nodes(topic, exercise)
        if re.search(technique, source_of(topic, exercise, node))
    )


def source_of(topic: str, exercise: str, node: str) -> str:
    """The source of a student's node, with everything of the students' modules that it uses."""
    found: dict[tuple[str, str], str] = {}
    names = [(f"tests.exercises.{topic}.{exercise}.students", node)]
    while names:
        module, name = names.pop()
        definition = _definitions(module).get(name)
        if isinstance(definition, tuple):
            names.append(definition)
        elif definition and (module, name) not in found:
            found[module, name] = definition
            names += [(module, word) for word in re.findall(r"\w+", definition)]
    return "\n".join(found.values())


@functools.cache
def _definitions(module: str) -> dict[str, str | tuple[str, str]]:
    """The source of what a module defines, by name; for what it imports from students: module and name."""
    text = (ROOT / f"{module.replace('.', '/')}.py").read_text(encoding="utf-8")
    found: dict[str, str | tuple[str, str]] = {}
    for item in ast.parse(text).body:
        if isinstance(item, ast.ImportFrom) and (item.module or "").startswith("tests."):
            found |= {name.asname or name.name: (item.module, name.name) for name in item.names}
        elif isinstance(item, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            found[item.name] = ast.get_source_segment(text, item)
        elif isinstance(item, ast.Assign):
            targets = (part for target in item.targets for part in ast.walk(target))
            names = (part.id for part in targets if isinstance(part, ast.Name))
            found |= dict.fromkeys(names, ast.get_source_segment(text, item))
    return found


def one_line(text: str) -> str:
    """The text with one space for each gap between words."""
    return " ".join(text.split())
