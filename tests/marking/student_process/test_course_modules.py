"""What of the course a student's process can import, topic by topic, and that what is left works."""

import importlib
import pkgutil

import pytest

import grader
import grader.exercises

TOPICS = [module.name for module in pkgutil.iter_modules(grader.exercises.__path__)]
CLOSED = tuple(f"grader.{name}" for name in ("exercises.", "companions", "geometry", "responses", "worlds",
                                             "marking.judge"))  # fmt: skip
WITH_ANSWERS = [
    module.name
    for module in pkgutil.walk_packages(grader.__path__, "grader.")
    if module.name.startswith(CLOSED)
]
IMPORT_ALL = """
import importlib
for name in {names}:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError:
        continue
    print(name)
"""
EMPTY_GLOBALS = """
import functools, inspect
from grader.exercises import {topic}
for name, value in vars({topic}).items():
    value = value.func if isinstance(value, functools.partial) else value
    owners = [value, *(vars(value).values() if inspect.isclass(value) else [])]
    for function in filter(inspect.isfunction, map(inspect.unwrap, filter(callable, owners))):
        for used in function.__code__.co_names:
            found = function.__globals__.get(used)
            if getattr(found, "__globals__", {{"": 0}}) == {{}}:
                print(name, function, used)
        if "__name__" not in function.__globals__:
            print(name, function)
"""
# What earned the points of 6.1, 6.4, 11.6, 12.1 and 13.1 when it was handed in.
TRICKS = {
    "navigator": [
        "from grader.exercises.navigator.compass import _bearing, _distance",
        "import grader.geometry.ground",
        "from grader.exercises.delivery import Floor",
    ],
    "packages": [
        "from grader.companions.patrol_package import FILES",
        "from grader.marking.judge.patrol_faults import FILES",
    ],
    "safety": ["from grader.companions.speed_candidates import _right", "safety.workshop(1)[0].args"],
    "delivery": ["from grader.exercises.delivery.blueprint import TOPICS", "delivery.blueprint.TOPICS"],
}
ERRORS = "ModuleNotFoundError", "ImportError", "IndexError", "AttributeError"


@pytest.mark.parametrize("topic", TOPICS)
def test_notebooks_import_their_package_and_nothing_else_that_holds_answers(start_student, topic):
    student = start_student(packages=[f"grader.exercises.{topic}"])
    names = student.text(IMPORT_ALL.format(names=WITH_ANSWERS)).split()
    assert names == ["grader.companions.main_observer", f"grader.exercises.{topic}"]
    assert student.text(EMPTY_GLOBALS.format(topic=topic)) == ""
    public = vars(importlib.import_module(names[1]))
    here = student.text(f"from grader.exercises import {topic}\nprint(*vars({topic}))").split()
    assert [name for name in public if not hasattr(public[name], "__path__") and name not in here] == []


@pytest.mark.parametrize("topic", TRICKS)
def test_right_functions_and_reference_data_are_not_there(start_student, topic):
    student = start_student(packages=[f"grader.exercises.{topic}"])
    for trick in TRICKS[topic]:
        (output,) = student.run(f"from grader.exercises import {topic}\n{trick}")
        assert output["ename"] in ERRORS, trick


def test_an_import_that_is_refused_says_what_can_be_imported(start_student):
    (output,) = start_student(packages=["grader.exercises.topics"]).run("import grader.exercises.safety")
    assert output["evalue"] == (
        "No module named 'grader.exercises.safety' when a class is marked: of the grader, notebooks can "
        "import grader and grader.exercises.topics"
    )


def test_exercises_have_no_checks_and_grade_nothing_in_a_cell_that_is_no_test(start_student):
    student = start_student(packages=["grader.exercises.topics"])
    student.run("from grader.exercises import topics\nfrom grader import catalog")
    checks = student.text("print([each.checks for each in catalog.exercises().values() if each.checks])")
    assert checks == "[]\n"
    text = "Not graded here: when a class is marked, the test cells are.\n"
    assert student.text("_ = topics.square.grade(int)") == text
