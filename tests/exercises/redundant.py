"""Wrong nodes of an exercise that can go: what they show and what they find out, nodes that stay do as well.

python -m tests.exercises.redundant topics/imu nodes/heart

A node shows sentences with its misses, and finds out a mutant of the checks if that gives it another score.
Recordings are judged again and nothing is run, so a mutant of what is run is left out.
The right nodes stay, those that a rule, a test or another node names, and as few others as together show
every sentence and find out each mutant that any node finds out.
"""

from __future__ import annotations

import ast
import functools
import importlib
import random
import re
import signal
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import sim
from grader import Exercise
from sim import Recording
from tests.exercises.builds import kept_builds
from tests.exercises.evidence import Evidence
from tests.exercises.score_tables import ROOT, folder_of, page, shown, students
from tests.exercises.seeds import exercise_of, right_nodes
from tests.mutants.changes import Mutant, mutants_of
from tests.mutants.loading import import_from, noting, statements_run
from tests.students.teams import programs_of

MOST = 100  # mutants that are tried of a module
SECONDS = 10.0  # of computing that a score with a mutant may take
VARIES = re.compile(r"“[^”]*”|'[^']*'|\"[^\"]*\"|/[\w/]+|-?\d+(\.\d+)?")  # names and numbers in what is shown


class NotJudged(BaseException):
    """A mutant that asks for other runs, or never ends."""


def words(block: str) -> set[str]:
    """The misses that a page says of a node, without the names and the numbers in them."""
    return {VARIES.sub("_", miss).strip() for miss in block.split("\n- ")[1:]}


def fewest(shows: dict[str, set[str]], kept: set[str]) -> set[str]:
    """Those that are kept, and as few others as together show all that any of them shows."""
    kept, left = set(kept), set().union(*shows.values()).difference(*(shows[name] for name in kept))
    while left:
        best = max(shows, key=lambda name: len(shows[name] & left))
        kept, left = kept | {best}, left - shows[best]
    return kept


def with_used(kept: set[str], source: str) -> set[str]:
    """These names, and those at the top level of a module that they are made of."""
    uses: dict[str, set[str]] = {}
    for statement in ast.parse(source).body:
        named = [part for part in ast.walk(statement) if isinstance(part, ast.Name)]
        stored = {part.id for part in named if isinstance(part.ctx, ast.Store)}
        for name in {statement.name} if hasattr(statement, "name") else stored:
            uses.setdefault(name, set()).update(part.id for part in named)
    found, before = set(kept), set[str]()
    while found != before:
        before = set(found)
        found.update(*(uses.get(name, set()) & set(uses) for name in before))
    return found


def named_by_tests(topic: str, name: str) -> set[str]:
    """All words of the rules and tests that concern an exercise; its nodes may be among them."""
    files = [*folder_of(topic, name).glob("*.toml"), *(ROOT / "tests/rules").glob("*.toml")]
    for path in {*(ROOT / "tests").rglob("*.py")} - {folder_of(topic, name) / "students.py"}:
        found = set(re.findall(r"\w+", path.read_text(encoding="utf-8")))
        files += [path] if {topic, name} <= found and path.name != "test_redundant.py" else []
    return set(re.findall(r"\w+", " ".join(path.read_text(encoding="utf-8") for path in files)))


class Recorded:
    """A node with the recordings of its first run; of all, if only these show what its page says."""

    def __init__(self, topic: str, name: str, node: str) -> None:
        self.node, self.programs = node, programs_of(students(topic, name)[node])
        self._make: Callable[..., Recording] = sim.run
        self._run = Evidence.of_nodes(topic).keeping(f"{name}-{node}", lambda *a, **k: self._make(*a, **k))
        self._whole, self._ran = False, dict[Exercise, set[int]]()
        if self.score(exercise_of(topic, name)) != page(topic, name)[node]:
            self._whole = True
        self.shown = self.score(exercise_of(topic, name))
        self.is_steady = self.shown == page(topic, name)[node]
        self._make = _refuse

    def score(self, exercise: Exercise) -> str:
        """What an exercise, or a mutant of it, says of the node."""
        from tests.exercises.assignment import first_run  # not before pytest has rewritten its assertions

        before, sim.run = sim.run, self._run
        try:
            return shown(self.node, (exercise if self._whole else first_run(exercise)).grade(*self.programs))
        finally:
            sim.run = before

    def concerns(self, mutant: Mutant, noted: Exercise) -> bool:
        """Whether its score runs what a mutant changes. noted: the exercise that notes statements."""
        if noted not in self._ran:
            statements_run.clear()
            self.score(noted)
            self._ran[noted] = set(statements_run)
        return mutant.function is None or mutant.statement in self._ran[noted]

    def finds_out(self, exercise: Exercise) -> bool:
        """Whether a mutant of the exercise gives another score; False if no recording can tell."""
        before = signal.signal(signal.SIGPROF, _refuse)
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        try:
            return self.score(exercise) != self.shown
        except NotJudged:
            return False
        except Exception:
            return True  # no score can be made of what it says
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            signal.signal(signal.SIGPROF, before)


def _refuse(*given: Any, **scenario: Any) -> Recording:
    raise NotJudged


def imported_anew(topic: str, name: str, module: str, tree: ast.Module) -> Exercise | None:
    """The exercise with one of its own modules made of this tree; None if that can't be."""
    package, around = f"grader.exercises.{topic}.{name}", importlib.import_module(f"grader.exercises.{topic}")
    own = own_modules(package)
    exercise, finders = getattr(around, name), list(sys.meta_path)
    for key in own:
        del sys.modules[key]
    import_from(tree, module, str(own[module].__file__))
    try:
        return getattr(importlib.import_module(package), name)
    except Exception:
        return None
    finally:
        sys.meta_path[:] = finders
        for key in own_modules(package):
            del sys.modules[key]
        sys.modules.update(own)
        setattr(around, name, exercise)


def own_modules(package: str) -> dict[str, ModuleType]:
    """What is imported of an exercise."""
    return {key: item for key, item in sys.modules.items() if f"{key}.".startswith(f"{package}.")}


def judging_modules(package: str) -> Iterator[tuple[str, ast.Module]]:
    """The names and the trees of an exercise's own modules, but for those that have nodes."""
    for key, item in sorted(own_modules(package).items()):
        source = Path(str(item.__file__)).read_text(encoding="utf-8")
        if key == package or "rclpy" not in source:
            yield key, ast.parse(source)


def sample(tree: ast.Module) -> list[Mutant]:
    """Some mutants of a module; without those of texts, which show on the page."""
    mutants = [it for it in mutants_of(tree) if not (isinstance(it.new, ast.Constant) and it.new.value == "")]
    return random.Random(0).sample(mutants, min(len(mutants), MOST))


def redundant(topic: str, name: str) -> list[str]:
    """The names of the nodes that can go."""
    source = (folder_of(topic, name) / "students.py").read_text(encoding="utf-8")
    shows = {node: words(block) for node, block in page(topic, name).items()}
    needed = {*right_nodes(topic, name), *named_by_tests(topic, name)} & set(shows)
    kept = with_used(fewest(shows, needed), source)
    recorded = functools.cache(functools.partial(Recorded, topic, name))
    with kept_builds():
        kept |= {node for node in shows if node not in kept and not recorded(node).is_steady}
        for module, tree in judging_modules(f"grader.exercises.{topic}.{name}"):
            noted = imported_anew(topic, name, module, noting(tree))
            for mutant in sample(tree):
                spare = [recorded(node) for node in shows if node not in kept]
                spare = [node for node in spare if noted and node.concerns(mutant, noted)]
                undo = replace(mutant, new=mutant.apply())
                exercise = imported_anew(topic, name, module, tree) if spare else None
                undo.apply()
                if exercise and (found := next((node for node in spare if node.finds_out(exercise)), None)):
                    alike = sorted(kept & set(shows), key=lambda it: -len(shows[it] & shows[found.node]))
                    if not any(recorded(node).finds_out(exercise) for node in alike):
                        kept = with_used(kept | {found.node}, source)
    return [node for node in shows if node not in kept]


if __name__ == "__main__":
    for wanted in sys.argv[1:]:
        print(wanted, *redundant(*wanted.split("/")), flush=True)
