"""Score tables of 13_delivery: a page for each exercise in tests/exercises/delivery/."""

import ast

from grader.exercises import delivery
from tests.exercises.assignment import Assignment
from tests.exercises.score_tables import ROOT


class TestDelivery(Assignment):
    folder = "13_delivery"
    package = delivery


class Untyped(ast.NodeTransformer):
    """Code without its types, which a lesson leaves out."""

    def visit_arg(self, node):
        node.annotation = None
        return node

    def visit_FunctionDef(self, node):
        node.returns = None
        return self.generic_visit(node)


def definitions(path):
    module = Untyped().visit(ast.parse((ROOT / path).read_text()))
    named = [node for node in module.body if isinstance(node, ast.FunctionDef | ast.ClassDef)]
    return {node.name: ast.dump(node) for node in named}


def test_students_are_given_what_the_lesson_has_beside_it():
    assert definitions("grader/exercises/delivery/floor.py") == definitions("course/13_delivery/floor.py")
