"""Score tables of 13b_delivery: a page for each exercise in tests/exercises/delivery/."""

import ast

import pytest
from rclpy.node import Node

from grader.exercises import delivery
from grader.programs import LocalPrograms
from tests.exercises.assignment import Assignment
from tests.exercises.reference import solution
from tests.exercises.score_tables import ROOT
from tests.exercises.seeds import fallen_short


class TestDelivery(Assignment):
    folder = "13b_delivery"
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
    given = definitions("grader/companions/map_messages.py") | definitions("grader/geometry/floor.py")
    assert given == definitions("course/13_delivery/floor.py")


def idle():
    return [lambda: Node("idle")]


def unsolved():
    raise NotImplementedError


def test_a_shift_has_questions_for_the_author_of_a_robot():
    assert [(one.begin, one.end) for one in delivery.questions(delivery.shift_of(idle))] == [
        *((0.0, 48.0), (2.0, 77.0), (58.3, 133.3)),  # it charged, left an order, and stood
    ]
    assert delivery.questions(delivery.shift_of(unsolved)) == []


def test_a_box_whose_side_comes_into_view_is_not_asked_for():
    """The lidar is off the middle of a robot that turns; with these seeds it sees more of a box by and by."""
    assert list(fallen_short("delivery", "perceive", range(18, 20))) == []


@pytest.mark.soak
def test_the_solutions_robot_earns_everything_when_a_class_is_marked():
    for number in range(4):
        score = delivery.deliver.judge(LocalPrograms(solution("delivery", "deliver")), f"secret {number}")
        assert float(score) == delivery.deliver.points
