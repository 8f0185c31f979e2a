"""What continuous integration calls is there, and score pages that change are reported."""

import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from _pytest.mark.expression import Expression

from tests.conftest import differences_of, is_extra

ROOT = Path(__file__).parents[2]
FILES = (".github/workflows/check.yml", ".gitlab-ci.yml", ".devcontainer/devcontainer.json")
MAKES_OWN = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "ARGS")  # the variables of a make that runs the tests
DOCKERFILE = ROOT / ".binder" / "Dockerfile"


def load(name, folder=".ci"):
    """A program of .ci/, or of another folder, as a module."""
    loader = importlib.machinery.SourceFileLoader(name.removesuffix(".py"), str(ROOT / folder / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


pages = load("pages")


def git(folder: Path, *arguments: str) -> str:
    who = ["-c", "user.name=a", "-c", "user.email=a@b"]
    return subprocess.check_output(["git", *who, *arguments], cwd=folder, text=True).strip()


@pytest.fixture
def change(tmp_path, monkeypatch) -> str:
    """A repository with two pages and a change in it; the commit that the change builds on."""
    for topic in ("nodes", "topics"):
        (tmp_path / "tests/exercises" / topic / "a").mkdir(parents=True)
        (tmp_path / "tests/exercises" / topic / "a/page.txt").write_text("Right: 5\n\nWrong: 2\n")
    (tmp_path / "tests/exercises/score_tables.py").touch()  # makes every page as it is
    git(tmp_path, "init", "--quiet", "--initial-branch=main")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "--quiet", "--message=before")
    monkeypatch.chdir(tmp_path)
    return git(tmp_path, "rev-parse", "HEAD")


@pytest.mark.parametrize("file", FILES)
def test_a_workflow_calls_what_there_is(file):
    text = (ROOT / file).read_text(encoding="utf-8")
    settings = json.loads(text) if file.endswith("json") else yaml.safe_load(text)
    assert settings
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.M))
    assert set(re.findall(r"\bmake ([a-z]+)", text)) - targets == set()
    called = re.findall(r"(?<![\w/.])\.ci/\w+(?:\.\w+)?", text)
    assert [path for path in called if not (ROOT / path).exists()] == []


@pytest.mark.parametrize("file", FILES[:2])
def test_both_services_run_the_solutions_the_pages_and_everything(file):
    text = (ROOT / file).read_text(encoding="utf-8")
    for command in ('make solutions ARGS="--junit solutions.xml"', ".ci/run", ".ci/pages"):
        assert command in text
    for kept in ("cache/uv", "cache/ros2-course-interfaces", "requirements.lock"):
        assert kept in text


def selected(expression: str) -> list[str]:
    """The kinds of tests that `-m EXPRESSION` of pytest selects."""
    kinds = {"plain": set(), "extras": {"extras"}, "soak": {"soak"}, "both": {"extras", "soak"}}
    asked = Expression.compile(expression)

    def selects(marks: set[str]) -> bool:
        return asked.evaluate(lambda name, **_: name in marks)

    return [kind for kind, marks in kinds.items() if selects(marks)]


def test_the_tests_of_extras_run_in_ci_and_on_request():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (plain,) = re.findall(r"-m '(.*?)'", settings["tool"]["pytest"]["ini_options"]["addopts"])
    (in_ci,) = re.findall(r'^which="(.+)"$', (ROOT / ".ci/run").read_text(encoding="utf-8"), re.M)
    (asked,) = re.findall(r"-m '(.*?)'", (ROOT / "Makefile").read_text(encoding="utf-8"))
    assert (selected(plain), selected(in_ci), selected(asked)) == (["plain"], ["plain", "extras"], ["extras"])


def test_a_run_that_names_extras_tests_them():
    test = "tests/marking/extras/hub/test_machine.py::test_it"
    assert is_extra(test, ["tests"]) and is_extra(test, [f"{ROOT}/tests/marking"])
    assert not is_extra(test, ["tests/marking/extras/hub"])
    assert not is_extra("tests/marking/test_pool.py::test_it", ["tests"])


def test_the_main_pages_in_the_browser_are_no_extras():
    assert is_extra("tests/browser/test_robot_sidebar.py::test_it", ["tests"])
    assert not is_extra("tests/browser/test_robot_sidebar.py::test_it", ["tests/browser"])
    assert not is_extra("tests/browser/test_students_lab.py::test_it", ["tests"])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [("", ""), ("extras", "-m 'extras and not soak' "), ("extras -k hub", "-m 'extras and not soak' -k hub"),
     ("-m 'not soak'", "-m 'not soak'")],
)  # fmt: skip
def test_make_test_hands_its_arguments_to_pytest(arguments, words):
    make = ["make", "--dry-run", "--old-file=tools", "test", f"ARGS={arguments}"]
    alone = {name: value for name, value in os.environ.items() if name not in MAKES_OWN}
    done = subprocess.run(make, cwd=ROOT, env=alone, check=True, capture_output=True, text=True)
    assert done.stdout.splitlines()[-1].endswith(f" --dist loadfile {words}")


def test_the_container_is_made_of_one_file_and_takes_only_what_it_names():
    settings = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
    assert (ROOT / ".devcontainer" / settings["build"]["dockerfile"]).resolve() == DOCKERFILE
    text = DOCKERFILE.read_text()
    assert {"gcc", "g++", "python3-dev"} <= set(text.split())  # lesson 11 compiles messages
    assert re.findall(r"^USER (.*)$", text, re.M) == ["$NB_USER"]
    assert text.index("\nUSER ") < text.index("make setup")
    copied = re.findall(r"^COPY (?:--\S+ )*(.+) \S+$", text, re.M)
    names = {name for line in copied for name in line.split()}
    assert [name for name in names if not (ROOT / name).exists()] == []
    assert names.isdisjoint({".", "class", "solutions", "tests", ".secret", ".git"})


def test_a_change_of_an_exercise_concerns_its_pages_and_one_of_a_check_concerns_all(change):
    assert pages.topics(["grader/exercises/nodes/hello.py"]) == ["nodes"]
    assert pages.topics(["tests/exercises/topics/a/students.py", "README.md"]) == ["topics"]
    assert pages.topics(["grader/checks/motion.py"]) == ["nodes", "topics"]
    assert pages.topics(["sim/run.py"]) == ["nodes", "topics"]
    assert pages.topics(["grader/marking/pool.py", "course/01_nodes/lesson.ipynb"]) == []


def test_nothing_changed_is_said(change):
    assert pages.report(change) == (
        "No score page changed: every sample node gets the points and words it got before.\n"
    )


def test_a_page_that_changes_is_shown_with_its_lines(change, tmp_path):
    (tmp_path / "tests/exercises/nodes/a/page.txt").write_text("Right: 5\n\nWrong: 3\n")
    git(tmp_path, "commit", "--quiet", "--all", "--message=change")
    said = pages.report(change)
    assert said.startswith("### Score pages that change\n\n- `tests/exercises/nodes/a/page.txt`\n\n```diff\n")
    assert "\n-Wrong: 2\n+Wrong: 3\n" in said
    assert "score_tables" not in said


def test_a_page_that_no_one_committed_ends_with_1_and_the_command(change, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("GITHUB_ACTIONS", "true")
    (tmp_path / "tests/exercises/topics/a/page.txt").write_text("Right: 4\n")
    assert pages.main(change) == 1
    reported = capsys.readouterr()
    assert "- `tests/exercises/topics/a/page.txt`: **not committed**, run the command below\n" in reported.out
    assert "`.venv/bin/python -m tests.exercises.score_tables topics/a` writes them" in reported.out
    assert reported.err.splitlines()[-1] == (
        "::error file=tests/exercises/topics/a/page.txt::"
        "These points or words are no longer what the sample nodes get."
    )


def test_the_pages_of_a_changed_exercise_are_made_anew(change, tmp_path, capfd, monkeypatch):
    monkeypatch.delenv("GITHUB_ACTIONS", raising=False)
    (tmp_path / "tests/exercises/score_tables.py").write_text(
        "import pathlib, sys\n"
        "pathlib.Path('tests/exercises', sys.argv[1], 'a/page.txt').write_text('Right: 6\\n')\n"
    )
    (tmp_path / "grader/exercises/nodes").mkdir(parents=True)
    (tmp_path / "grader/exercises/nodes/a.py").touch()
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "--quiet", "--message=change")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, ROOT / ".ci/pages", change], env=environment, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (1, "Making the score pages of nodes ...\n")
    assert "+Right: 6" in done.stdout


def test_without_a_commit_it_says_how_it_is_called(tmp_path):
    done = subprocess.run([sys.executable, ROOT / ".ci/pages"], capture_output=True, text=True)
    assert (done.returncode, done.stderr.splitlines()[0]) == (
        1,
        "Which score pages a change alters, as Markdown: .ci/pages BASE   (run by the environment's Python)",
    )


def test_each_difference_of_a_distribution_is_that_of_a_test():
    rows = differences_of("kilted")
    assert rows and differences_of("jazzy") == {}
    for test in rows:
        file, *owner, function = test.partition("[")[0].split("::")
        inherited = "tests/exercises/assignment.py" if owner else file
        assert f"def {function}(" in (ROOT / inherited).read_text("utf-8"), test
