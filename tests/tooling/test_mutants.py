"""The script that mutates a module: on a small one, with a change that its tests don't notice."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.mutants.changes import mutants_of
from tests.mutants.forks import result_of, truths

ROOT = Path(__file__).parents[2]
MODULE = '''
"""Speeds."""

MOST = 2


def limited(speed):
    """A speed within the limits."""
    if speed > MOST:
        return MOST
    return speed


def stops(speed):
    return speed == 0
'''
TESTS = """
from robot.speeds import limited


def test_a_speed_beyond_the_limit_is_cut():
    assert limited(3) == 2


def test_a_small_speed_stays():
    assert limited(1) == 1


def test_it_is_documented():
    assert limited.__doc__ == "A speed within the limits."
"""
OUTCOMES = """\
killed      robot/speeds.py:4  MOST = 2 → MOST = 3
killed      robot/speeds.py:4  MOST = 2 → MOST = 1
SURVIVED    robot/speeds.py:9  speed > MOST → speed >= MOST
killed      robot/speeds.py:10  return MOST → return None
killed      robot/speeds.py:11  return speed → return None
SURVIVED    robot/speeds.py:15  return speed == 0 → return None
SURVIVED    robot/speeds.py:15  return speed == 0 → return speed != 0
SURVIVED    robot/speeds.py:15  speed == 0 → speed == 1
SURVIVED    robot/speeds.py:15  speed == 0 → speed == -1
module           mutants  killed  survived  equivalent
robot/speeds.py        9       4         5           0
"""


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A folder with a module and its tests, in which the script runs."""
    for name, text in {"robot/speeds.py": MODULE, "tests/robot/test_speeds.py": TESTS}.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    return tmp_path


def mutants(*arguments):
    command = [sys.executable, "-m", "tests.mutants", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_each_mutant_is_printed_with_its_place_and_whether_a_test_noticed_it(project):
    done = mutants("robot/speeds.py")
    assert (done.stdout, done.stderr, done.returncode) == (OUTCOMES, "", 1)
    assert (project / "robot" / "speeds.py").read_text() == MODULE


def test_a_sample_is_the_same_each_time_and_other_tests_can_be_named(project):
    (project / "more.py").write_text("from robot.speeds import stops\ndef test_it():\n    assert stops(0)\n")
    first, second = (mutants("robot", "--sample", "4", "--seed", "2", "--tests", "more.py") for _ in range(2))
    assert first.stdout == second.stdout
    assert first.stdout.splitlines()[-1] == "robot/speeds.py        4       1         3           0"


def test_each_of_several_modules_is_imported_anew(project):
    (project / "robot" / "turns.py").write_text(MODULE.replace("speed", "turn"))
    (project / "tests" / "robot" / "test_turns.py").write_text(TESTS.replace("speed", "turn"))
    turns = OUTCOMES.replace("speed", "turn").splitlines()[-1]
    *_, first, second = mutants("robot").stdout.splitlines()
    assert (first, second) == (OUTCOMES.splitlines()[-1], turns.replace("turns.py ", "turns.py  "))


def test_a_mutant_that_nothing_can_notice_is_excused_and_a_reason_for_no_mutant_is_refused(project):
    folder = project / "tests" / "mutants"
    folder.mkdir()
    excuse = "robot/speeds.py limited: speed > MOST → speed >= MOST  # at the limit both give the limit\n"
    (folder / "equivalent.txt").write_text(excuse)
    assert "equivalent  robot/speeds.py:9  speed > MOST → speed >= MOST\n" in mutants("robot").stdout
    (folder / "equivalent.txt").write_text(excuse.replace("MOST", "LEAST"))
    problem = "robot/speeds.py limited: speed > LEAST → speed >= LEAST"
    assert mutants("robot").stderr == (
        f"robot/speeds.py: tests/mutants/equivalent.txt has what isn't one of its mutants: {problem}\n"
    )


def test_without_tests_that_pass_there_is_an_error_in_place_of_outcomes(project):
    (project / "tests" / "robot" / "test_speeds.py").write_text("def test_it():\n    assert False\n")
    done = mutants("robot")
    assert "robot/speeds.py: tests/robot/test_speeds.py::test_it\n" in done.stderr
    assert "assert False" in done.stderr
    (project / "tests" / "robot" / "test_speeds.py").write_text("import no_such_module\n")
    problem = mutants("robot").stderr
    assert problem.startswith("robot/speeds.py: The tests can't be collected.\n")
    assert "ModuleNotFoundError: No module named 'no_such_module'\n" in problem
    (project / "tests" / "robot" / "test_speeds.py").unlink()
    done = mutants("robot")
    missing = "expected tests in tests/robot/test_speeds.py, which is missing"
    hint = "write it, or name others with --tests"
    assert (done.returncode, done.stderr) == (1, f"robot/speeds.py: {missing}: {hint}\n")


def changes(source):
    return [f"{mutant.before} → {mutant.after}" for mutant in mutants_of(ast.parse(source))]


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("a <= b", ["a <= b → a < b"]),
        ("a is not b", ["a is not b → a is b"]),
        ("a not in b", ["a not in b → a in b"]),
        ("a - b", ["a - b → a + b"]),
        ("a / b", ["a / b → a * b"]),
        ("'a' + b", []),
        ("a += b", ["a += b → pass", "a += b → a -= b"]),
        ("a or b", ["a or b → a and b", "a or b → b", "a or b → a"]),
        ("not a", ["not a → a"]),
        ("-a", ["-a → a"]),
        ("a = 3", ["a = 3 → a = 4", "a = 3 → a = 2"]),
        ("a = 0.0", ["a = 0.0 → a = 1.0"]),
        ("a = 0.5", ["a = 0.5 → a = 0.625", "a = 0.5 → a = 0.4"]),
        ("a = 1e-6", ["a = 1e-06 → a = 0.0", "a = 1e-06 → a = 0.001"]),
        ("a = True", ["a = True → a = False"]),
        ("a = 'b c'", ["a = 'b c' → a = ''"]),
        ("a = f'{b} c'", ["a = f'{b} c' → a = ''"]),
        ("a = 'b'", []),
        ("if a:\n  b", ["a → not a"]),
        ("a if b else c", ["b → not b"]),
        ("[a for a in b if a]", ["for a in b if a → for a in b if not a"]),
        ("f(a=b)", ["f(a=b) → pass", "f(a=b) → f()"]),
        ("b = f(c, a=True)", ["a=True → a=False"]),
        ("b = max(c)", ["b = max(c) → b = min(c)"]),
        ("b = math.floor(c)", ["b = math.floor(c) → b = math.ceil(c)"]),
        ("b = abs(c)", ["b = abs(c) → b = c"]),
        ("if a > b:\n  c = d", ["a > b → a >= b", "c = d → pass"]),
        ("while a > b:\n  break", ["a > b → a >= b", "break → continue"]),
        ("while a > b:\n  continue", ["a > b → a >= b", "continue → break"]),
        ("raise a", ["raise a → pass"]),
        ("def f(a=1):\n  'A text.'\n  return a", ["a=1 → a=2", "a=1 → a=0", "return a → return None"]),
        ("def f():\n  return None\n  return {}", []),
        ("@dataclass(frozen=True)\nclass A:\n  b: Literal['c d'] = c", []),
        ("__all__ = ['a b']\nif TYPE_CHECKING:\n  import a", []),
    ],
)
def test_each_kind_of_change(source, expected):
    assert changes(source) == expected


def test_a_mutant_knows_the_outermost_function_that_runs_it():
    source = "class A:\n  @b\n  def f(self, c=1):\n    def g():\n      return 2"
    found = {(mutant.after, mutant.line, mutant.function) for mutant in mutants_of(ast.parse(source))}
    assert {("self, c=2", 3, None), ("return 3", 5, ("A.f", 2)), ("return None", 5, ("A.f", 2))} <= found


def test_what_a_fork_changes_is_gone_and_one_that_never_ends_is_ended():
    found = []
    assert result_of(lambda: found.append(1) or found) == [1]
    functions = {0: lambda: True, 1: lambda: bool(found), 2: endless, 3: lambda: 1 / 0}
    assert truths(functions, 0.0) == {0: True, 1: False, 2: False, 3: False}


def endless():
    while True:
        pass


def test_a_fork_that_fails_is_an_error_with_its_traceback():
    with pytest.raises(RuntimeError, match="ZeroDivisionError: division by zero"):
        result_of(lambda: 1 / 0)
    with pytest.raises(RuntimeError, match=r"^Its process ended\.$"):
        result_of(lambda: os._exit(1))
