"""The programs that a lesson calls wrong, and how near a student's node is to one of them.

Such a program is a class or a function that

- a cell of code defines that says "please don't" or "poor",
- or the next cells of code define, after a text that says "What goes wrong" or "please don't", or after a
  prediction: what it does may surprise,
- or that a block of Python in such a text has, which may be a program without a function.

A node is adapted from it by renaming only. `likeness` compares two programs as trees, without docstrings:
constants count by their type, and names that only one of the two has by the order in which they appear.
"""

from __future__ import annotations

import ast
import difflib
import re
from collections.abc import Iterator, Sequence

from tests.exercises.score_tables import folder_of, page
from tests.exercises.seeds import right_nodes
from tests.rules.statements import POOR_CODE
from tests.rules.table import Cell, Table

ENOUGH = 0.9
"""How alike a node and a lesson's program are at least."""
CALLS_WRONG = re.compile(r"what goes wrong|please don't", re.I)
PREDICTS = re.compile(r"\bpredict\(")
BLOCK = re.compile(r"^```python\n(.*?)^```", re.M | re.S)
# Why no node is adapted from a program.
REASONS = {
    "same mistake": "an exercise has a wrong node with this mistake, in a program of another shape",
    "no exercise": "no exercise asks for what it gets wrong",
    "not wrong": "it is the cure, or shows what goes wrong with another program",
}

Definition = ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
Token = tuple[str, str]


def called_wrong(cells: dict[str, Cell]) -> dict[str, list[Definition]]:
    """The definitions that a lesson calls wrong, by the cell of code that has them."""
    found, is_called = {}, False
    for name, cell in cells.items():
        if cell.kind == "code":
            called = cell.source if is_called or POOR_CODE.search(cell.source) else ""
            defined = _definitions(called)
            is_called |= bool(PREDICTS.search(cell.source))
        else:
            is_called = bool(CALLS_WRONG.search(cell.source))
            blocks = BLOCK.findall(cell.source) if is_called else []
            defined = [item for block in blocks for item in _definitions(block) or [_program(block)]]
        found |= {name: defined} if defined else {}
    return found


def _program(source: str) -> Definition:
    """Statements as a function."""
    [made] = ast.parse("def program(): pass").body
    made.body = ast.parse(source).body
    return made


def _definitions(source: str) -> list[Definition]:
    tree = ast.Module([], []) if source.startswith(("%", "!")) else ast.parse(source)
    return [item for item in tree.body if isinstance(item, Definition)]


def definition_of(topic: str, exercise: str, node: str) -> Definition:
    """The definition of a student's node; of `node = main_of(Part)` that of the part."""
    text = (folder_of(topic, exercise) / "students.py").read_text(encoding="utf-8")
    known = {item.name: item for item in _definitions(text)}
    for item in ast.parse(text).body:
        if isinstance(item, ast.Assign) and ast.unparse(item.targets[0]) == node:
            [node] = {ast.unparse(argument) for argument in item.value.args[:1]}
    return known[node]


def likeness(one: Definition, other: Definition) -> float:
    """How alike two programs are, from 0 to 1; 1 if renaming turns one into the other."""
    parts = [[*filter(None, [getattr(item, "args", None)]), *item.body] for item in (one, other)]
    tokens = [list(_tokens(part)) for part in parts]
    shared = set.intersection(*({text for kind, text in part if kind == "name"} for part in tokens))
    return difflib.SequenceMatcher(None, *(_renamed(part, shared) for part in tokens), autojunk=False).ratio()


def _renamed(tokens: Sequence[Token], shared: set[str]) -> list[Token]:
    """Names that the other program lacks are numbered, in their order."""
    numbers: dict[str, str] = {}
    return [
        (kind, numbers.setdefault(text, str(len(numbers))) if kind == "name" and text not in shared else text)
        for kind, text in tokens
    ]


def _tokens(body: Sequence[ast.AST]) -> Iterator[Token]:
    """A program as a sequence: kinds of nodes, names, and types of constants."""
    for node in body:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue  # a docstring
        yield type(node).__name__, ""
        if isinstance(node, ast.Constant):
            yield "constant", type(node.value).__name__
        else:
            yield from (("name", text) for _, text in ast.iter_fields(node) if isinstance(text, str))
        yield from _tokens(list(ast.iter_child_nodes(node)))
        yield "end", ""


def problems(table: Table, cells: dict[str, Cell]) -> Iterator[str]:
    """What is wrong with the programs of a table, as sentences."""
    programs = called_wrong(cells)
    listed = {cell for rule in table.rules for cell, _ in rule.programs} | {cell for cell, _ in table.no_node}
    yield from (f"{cell}: it is called wrong, and no row has it" for cell in programs if cell not in listed)
    yield from (f"{cell}: nothing there is called wrong" for cell in sorted(listed) if cell not in programs)
    for cell, text in table.no_node:
        reason, _, why = text.partition(": ")
        if reason not in REASONS or not why:
            yield f"{cell}: “{text}” is none of the reasons {', '.join(REASONS)}, with a sentence"
        elif reason == "same mistake":
            topic, exercise, node = re.split(r"/|: ", why)
            if node not in page(topic, exercise) or node in right_nodes(topic, exercise):
                yield f"{cell}: {why} is no wrong node"
    for rule in table.rules:
        place = rule.check.partition(":")[0].split("/")
        for cell, node in rule.programs:
            if node not in rule.wrong:
                yield f"{cell}: {node} is no wrong node of “{rule.rule}”"
            elif cell in programs:
                adapted = definition_of(*place, node)
                alike = max(likeness(program, adapted) for program in programs[cell])
                if alike < ENOUGH:
                    yield f"{cell}: {node} is {alike:.2f} like the lesson's program, and not {ENOUGH:g}"
