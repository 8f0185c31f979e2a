"""A class whose students wrote designs of their own, and some pairs where one text derives from the other.

Each student's answer to an exercise is one of the nodes in tests/exercises/topics/, with statements that only
this student has. A derived text has other names, another order of methods, no comments and other numbers.
"""
import ast
import copy
import functools
import random
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from tests.marking.tiny import ROOT

ASSIGNMENT, NOTEBOOK = "02_topics", "topics.ipynb"
EXERCISES = ("greeting", "temperature", "square", "imu", "chatters", "commands")
OWN = (
    "self.{0} = [{1}, {2}]",
    "if self.{0} and self.{0}[-1] > {1}: self.{0}.pop()",
    "for {0} in range({1}): self.get_logger().debug(str({0} * {2}))",
    "self.{0} = {{'{0}': {1}}}",
    "self.{0} = max({1}, min({2}, self.count or {1}))",
    "while len(self.{0}) > {1}: self.{0} = self.{0}[1:]",
    "self.{0}, {0} = {1}, not {2}",
    "assert isinstance({1}, (int, float)) or {2} is None",
)


@functools.cache
def designs(exercise: str) -> list[str]:
    """The nodes that students' files of an exercise define, each with the classes that it inherits from."""
    source = (ROOT / "tests" / "exercises" / "topics" / exercise / "students.py").read_text()
    classes = {node.name: node for node in ast.parse(source).body if isinstance(node, ast.ClassDef)}
    found = []
    for node in classes.values():
        bases = [base.id for base in node.bases if isinstance(base, ast.Name) and base.id in classes]
        found.append("\n\n".join(ast.unparse(classes[name]) for name in (*bases, node.name)))
    return [text for text in found if text.count("\n") > 6]


def individual(text: str, dice: random.Random) -> str:
    """The text with a few statements of the student's own in each function."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            for _ in range(dice.randint(1, 3)):
                name = "".join(dice.choices("abcdefgh", k=5))
                line = dice.choice(OWN).format(name, dice.randint(1, 99), dice.randint(1, 99))
                node.body.insert(dice.randint(1, len(node.body)), ast.parse(line).body[0])
    return ast.unparse(tree)


class _Renamed(ast.NodeTransformer):
    def visit_Name(self, node: ast.Name) -> ast.Name:
        return ast.Name(f"{node.id}_x" if node.id.islower() and node.id != "self" else node.id, node.ctx)

    def visit_Attribute(self, node: ast.Attribute) -> ast.Attribute:
        self.generic_visit(node)
        node.attr = f"my_{node.attr}" if isinstance(node.value, ast.Name) else node.attr
        return node

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.ClassDef:
        self.generic_visit(node)
        node.name = f"My{node.name}"
        node.body.reverse()
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        number = isinstance(node.value, float)
        return ast.Constant(node.value * 1.5) if number else node


def derived(text: str, dice: random.Random) -> str:
    """The text with other names, numbers and order of methods, and one statement more in some functions."""
    tree = _Renamed().visit(ast.parse(text))
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and dice.random() < 0.3:
            node.body.append(ast.parse("print('here')").body[0])
    return ast.unparse(ast.fix_missing_locations(tree))


def answers(dice: random.Random) -> dict[str, str]:
    """An answer to each exercise, by the ids of their cells."""
    return {name: individual(dice.choice(designs(name)), dice) for name in EXERCISES}


def with_answers(release: NotebookNode, texts: dict[str, str]) -> NotebookNode:
    notebook = copy.deepcopy(release)
    for cell in notebook.cells:
        settings = cell.metadata.get("nbgrader", {})
        if settings.get("grade_id") in texts and settings.get("solution"):
            cell.source = f"{cell.source}\n\n{texts[settings['grade_id']]}"
    return notebook


def hand_in(submitted: Path, students: int, pairs: int, seed: int = 55) -> set[frozenset[str]]:
    """Write a class's submissions; returns the pairs of which one derives from the other."""
    dice = random.Random(seed)
    release = nbformat.read(ROOT / "exercises" / ASSIGNMENT / NOTEBOOK, 4)
    written = {f"student{number:03}": answers(dice) for number in range(students - pairs)}
    planted = set()
    for number, origin in enumerate(dice.sample(sorted(written), pairs)):
        name = f"student{students - pairs + number:03}"
        written[name] = {exercise: derived(text, dice) for exercise, text in written[origin].items()}
        planted.add(frozenset({origin, name}))
    for name, texts in written.items():
        place = submitted / name / ASSIGNMENT / NOTEBOOK
        place.parent.mkdir(parents=True)
        nbformat.write(with_answers(release, texts), place)
    return planted
