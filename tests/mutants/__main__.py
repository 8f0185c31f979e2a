"""Finds out which small changes of a module its tests don't notice.

python -m tests.mutants grader/checks/verdicts.py                  run by tests/grader/checks/test_verdicts.py
python -m tests.mutants MODULE --tests tests/exercises -k smooth     run by other tests: arguments of pytest
python -m tests.mutants MODULE --sample 50 --seed 1                  50 of its mutants

It ends with 1 when fewer than nine of ten mutants of a module are killed, or tests fail without a mutant.
No file is changed. Mutants that no test can tell from the module are in equivalent.txt, each with its reason.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
from collections.abc import Sequence
from pathlib import Path

from tests.bench.report import table
from tests.mutants.changes import Mutant, mutants_of
from tests.mutants.running import NotTested, Target, survivors

ENOUGH = 0.9  # of a module's mutants are killed
EQUIVALENT = Path("tests", "mutants", "equivalent.txt")
LONG = 60  # characters of a change that are shown


def main(arguments: Sequence[str]) -> int:
    """Run the tests for the mutants of some modules; the exit status says whether they kill enough."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants")
    parser.add_argument("modules", nargs="+", metavar="MODULE", help="a file, or a folder of them")
    parser.add_argument("--sample", type=int, metavar="N", help="so many mutants of each module")
    parser.add_argument("--seed", type=int, default=0, help="another sample")
    parser.add_argument("--tests", nargs=argparse.REMAINDER, metavar="...", help="arguments of pytest")
    options = parser.parse_args(arguments)
    rows, refused = [], False
    for file in _files(options.modules):
        try:
            rows.append(_run(file, options.tests or [_mirror(file)], options.sample, options.seed))
        except NotTested as error:
            print(f"{file}: {error}", file=sys.stderr)
            refused = True
    table(("module", "mutants", "killed", "survived", "equivalent"), rows)
    return int(refused or any(killed < ENOUGH * (killed + survived) for _, _, killed, survived, _ in rows))


def _files(names: Sequence[str]) -> list[str]:
    found = []
    for name in names:
        path = Path(name)
        found += sorted(path.rglob("*.py")) if path.is_dir() else [path]
    return [path.as_posix() for path in found if mutants_of(_target(path.as_posix()).tree())]


def _mirror(file: str) -> str:
    """The module of tests that has the place and the name of a module."""
    path = Path("tests", Path(file.removeprefix("grader/") if "/exercises/" in file else file))
    path = path.with_name(f"test_{path.name}")
    if not path.exists():
        raise NotTested(f"expected tests in {path}, which is missing: write it, or name others with --tests")
    return path.as_posix()


def _target(file: str, tests: Sequence[str] = ()) -> Target:
    module = file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
    return Target(module, os.path.abspath(file), tuple(tests))


def _run(file: str, tests: Sequence[str], sample: int | None, seed: int) -> tuple[str, int, int, int, int]:
    target = _target(file, tests)
    mutants = mutants_of(target.tree())
    chosen = list(range(len(mutants)))
    if sample is not None and sample < len(chosen):
        chosen = sorted(random.Random(seed).sample(chosen, sample))
    excused = _equivalent(file, mutants)
    survived = survivors(target, [index for index in chosen if _text(file, mutants[index]) not in excused])
    for index in chosen:
        outcome = {None: "equivalent", True: "SURVIVED", False: "killed"}[survived.get(index)]
        print(f"{outcome:<10}  {file}:{mutants[index].line}  {_shown(mutants[index])}", flush=True)
    alive = sum(survived.values())
    return file, len(chosen), len(survived) - alive, alive, len(chosen) - len(survived)


def _equivalent(file: str, mutants: Sequence[Mutant]) -> set[str]:
    """The changes that the tests need not notice. Raises NotTested for one that isn't among the mutants."""
    lines = EQUIVALENT.read_text(encoding="utf-8").splitlines() if EQUIVALENT.exists() else []
    excused = {line.partition("  # ")[0] for line in lines if line.startswith(f"{file} ")}
    unknown = excused - {_text(file, mutant) for mutant in mutants}
    if unknown:
        raise NotTested(f"{EQUIVALENT} has what isn't one of its mutants: {unknown.pop()}")
    return excused


def _text(file: str, mutant: Mutant) -> str:
    """A change as it is written in equivalent.txt."""
    name = mutant.function[0] if mutant.function else "the module"
    return f"{file} {name}: {mutant.before} → {mutant.after}"


def _shown(mutant: Mutant) -> str:
    """A change, with dots in place of what is alike where it is long."""
    before, after = mutant.before, mutant.after
    alike = next((n for n, (a, b) in enumerate(zip(before, after, strict=False)) if a != b), 0)
    start = max(0, alike - LONG // 2) if max(len(before), len(after)) > LONG else 0
    return " → ".join(
        f"{'…' * (start > 0)}{text[start : start + LONG]}{'…' * (len(text) > start + LONG)}"
        for text in (before, after)
    )


if __name__ == "__main__":
    if os.environ.get("PYTHONHASHSEED") != "0":  # equal runs need equal orders
        os.environ["PYTHONHASHSEED"] = "0"
        os.execv(sys.executable, [sys.executable, "-m", "tests.mutants", *sys.argv[1:]])
    sys.exit(main(sys.argv[1:]))
