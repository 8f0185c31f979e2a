"""Advice on a package's programs: packages of the score pages earn each of them."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.error_advice import advice
from grader.diagnosis.package_rules import PACKAGE_RULES, own_module
from sim import run
from sim.evidence import CallbackError, Recording
from tests.exercises.score_tables import graded_exercises, page

HINTS = {
    line.removeprefix("  Hint: ")
    for exercise in graded_exercises("11_packages")
    for block in page("packages", exercise).values()
    for line in block.splitlines()
    if line.startswith("  Hint: ")
}


@pytest.mark.parametrize("rule", PACKAGE_RULES, ids=lambda rule: f"{rule.type} {rule.pattern[:20]}")
def test_each_advice_is_earned(rule):
    pattern = re.sub(r"\\{\d(!r)?\\}", ".+", re.escape(rule.advice))
    assert any(re.fullmatch(pattern, hint) for hint in HINTS)


@pytest.mark.parametrize(
    "words", ["The full name of a package's module", "patrol.driver has no mian", "was not installed"]
)
def test_each_advice_on_own_modules_is_earned(words):
    assert any(words in hint for hint in HINTS)


def test_elsewhere_a_module_that_is_not_there_has_its_usual_advice():
    error = CallbackError(0.0, "/n", "main", "ModuleNotFoundError", "No module named 'speeds'", "")
    assert own_module(error, Recording()) == ""
    assert advice(error).startswith("Python can't find a module `speeds`")


@pytest.mark.parametrize(
    ("arguments", "hint"),
    {
        "turtlesim multism.launch.py": "Is the name misspelled? Write multisim.launch.py.",
        "turtlesmi multisim.launch.py": "Is the name misspelled? Write turtlesim.",
        "zzz.launch.py": "The path is relative to the folder that is named; `ls` shows what is there.",
        "turtlesim zzz.launch.py": "zzz.launch.py was not installed. In setup.py, data_files needs "
        "('share/' + package_name + '/launch', glob('launch/*')).",
    }.items(),
)
def test_a_launch_file_that_is_not_found_gets_advice(arguments, hint, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert find_fault(run(arguments, seconds=1, quiet=True)).hint == hint
