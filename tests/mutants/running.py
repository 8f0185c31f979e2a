"""Runs the tests of a module once for each of its mutants, in forks that have imported all that they need."""

from __future__ import annotations

import ast
import contextlib
import functools
import gc
import importlib
import sys
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any, NamedTuple

import pytest
from _pytest.runner import runtestprotocol

from tests.mutants.changes import Function, Mutant, mutants_of
from tests.mutants.forks import result_of, truths
from tests.mutants.loading import import_from, noting, statements_run

SECONDS, TIMES = (
    20,
    10,
)  # a mutant may compute so long, and so many times as long as all tests take without it
OPTIONS = ["-s", "-p", "no:cacheprovider", "-W", "ignore"]


class NotTested(Exception):
    """The tests don't pass without a mutant, so with one they say nothing."""


class Target(NamedTuple):
    """A module of the working directory by its name, its file, and the tests that concern it."""

    module: str
    file: str
    tests: tuple[str, ...]  # arguments of pytest

    def tree(self) -> ast.Module:
        """Its syntax tree."""
        return ast.parse(Path(self.file).read_text(encoding="utf-8"))


class Traced(NamedTuple):
    """What the tests did without a mutant."""

    failures: list[str]
    seconds: list[float]  # of each test
    statements: list[set[int]]  # that each test has run


class Found(NamedTuple):
    """What became of mutants. left: those that change what is run when tests are imported."""

    failures: list[str]
    survived: dict[int, bool]
    left: list[int]
    imported: dict[str, str]  # names and files of modules
    seconds: float  # that one mutant may take


def survivors(target: Target, chosen: list[int]) -> dict[int, bool]:
    """Whether each of these mutants, given by their index, survives the tests.

    A function is changed in forks of a process that has imported the tests already. What was run by importing
    them is changed in forks that import the module anew, which takes about half a second. All of that is done
    in a fork of this process, so that the next module finds nothing imported.
    Raises NotTested where the tests fail without a mutant.
    """
    found: dict[int, bool] | str = result_of(lambda: _survivors(target, chosen))
    if isinstance(found, str):
        raise NotTested(found)
    return found


def _survivors(target: Target, chosen: list[int]) -> dict[int, bool] | str:
    found: Found = result_of(lambda: _run_pytest(target, _Warm(target, chosen), noting(target.tree())).found)
    if found.failures:
        return "\n\n".join(found.failures)
    for name in _independent_of(target.module, found.imported):
        with contextlib.suppress(Exception):
            importlib.import_module(name)
    left = {index: functools.partial(_survives_cold, target, index) for index in found.left}
    return found.survived | truths(left, found.seconds)


def _run_pytest(target: Target, plugin: Any, tree: ast.Module) -> Any:
    import_from(tree, target.module, target.file)
    pytest.main([*OPTIONS, *target.tests], plugins=[plugin])
    return plugin


def _survives_cold(target: Target, index: int) -> bool:
    tree = target.tree()
    mutants_of(tree)[index].apply()
    return _run_pytest(target, _Cold(), tree).passed


class _Cold:
    """A plugin of pytest that runs the tests until one fails."""

    passed = False

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self.passed = not session.testsfailed and _all_pass(session.items)
        return True


class _Warm:
    """A plugin of pytest that runs the tests it has collected for each mutant of a function."""

    def __init__(self, target: Target, chosen: list[int]) -> None:
        self.target, self.chosen, self.tree = target, chosen, target.tree()
        self.found = Found(["The tests can't be collected."], {}, [], {}, 0.0)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.found.failures.append(report.longreprtext)

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        if not session.testsfailed:
            imported = set(statements_run)
            traced: Traced = result_of(lambda: _trace(session.items))
            self.found = self._found(session.items, imported, traced)
        return True

    def _found(self, items: list[pytest.Item], imported: set[int], traced: Traced) -> Found:
        survived, left, jobs = {}, [], {}
        mutants, functions = mutants_of(self.tree), _functions_in(self.target.file)
        for index in self.chosen:
            mutant = mutants[index]
            found = functions[mutant.function[0] if mutant.function else ""]
            if mutant.statement in imported or not _can_be_changed(found):
                left.append(index)
            elif not any(mutant.statement in statements for statements in traced.statements):
                survived[index] = True
            else:
                first = _likeliest_first(items, traced, mutant.statement)
                jobs[index] = functools.partial(self._survives, mutant, found, first)
        seconds = SECONDS + TIMES * sum(traced.seconds)
        survived |= truths({} if traced.failures else jobs, seconds)
        return Found(traced.failures, survived, left, _files_of_modules(), seconds)

    def _survives(self, mutant: Mutant, functions: list[FunctionType], items: list[pytest.Item]) -> bool:
        mutant.apply()
        codes = dict(_codes(compile(self.tree, self.target.file, "exec", dont_inherit=True)))
        for function in functions:
            code = function.__code__
            function.__code__ = codes[code.co_qualname, code.co_firstlineno]
        return _all_pass(items)


def _codes(code: CodeType) -> Iterator[tuple[Function, CodeType]]:
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield (inner.co_qualname, inner.co_firstlineno), inner
            yield from _codes(inner)


def _functions_in(file: str) -> dict[str, list[FunctionType]]:
    """The functions that were defined in a file, by the name of the outermost function around each."""
    found = defaultdict(list)
    for item in gc.get_objects():
        if isinstance(item, FunctionType) and item.__code__.co_filename == file:
            found[item.__code__.co_qualname.split(".<locals>")[0]].append(item)
    return found


def _can_be_changed(functions: list[FunctionType]) -> bool:
    """Whether these get new code by themselves: there is one, and no inner functions that were made of it."""
    codes = [function.__code__ for function in functions]
    return bool(codes) and not any(code.co_freevars or "<locals>" in code.co_qualname for code in codes)


def _likeliest_first(items: list[pytest.Item], traced: Traced, statement: int) -> list[pytest.Item]:
    """The tests that run a statement, the quickest first; then all others, which may use what those made."""
    order = sorted(
        range(len(items)), key=lambda n: (statement not in traced.statements[n], traced.seconds[n])
    )
    return [items[n] for n in order]


def _trace(items: list[pytest.Item]) -> Traced:
    traced = Traced([], [], [])
    for item, following in _with_following(items):
        statements_run.clear()
        begin = time.perf_counter()
        reports = runtestprotocol(item, nextitem=following, log=False)
        traced.seconds.append(time.perf_counter() - begin)
        traced.statements.append(set(statements_run))
        traced.failures.extend(f"{item.nodeid}\n{one.longreprtext}" for one in reports if one.failed)
    return traced


def _all_pass(items: list[pytest.Item]) -> bool:
    for item, following in _with_following(items):
        if any(report.failed for report in runtestprotocol(item, nextitem=following, log=False)):
            return False
    return True


def _with_following(items: list[pytest.Item]) -> list[tuple[pytest.Item, pytest.Item | None]]:
    return list(zip(items, [*items[1:], None], strict=True))


def _files_of_modules() -> dict[str, str]:
    files = {name: getattr(module, "__file__", None) for name, module in list(sys.modules.items())}
    return {name: file for name, file in files.items() if file and file.endswith(".py")}


def _independent_of(module: str, imported: dict[str, str]) -> list[str]:
    """Those of the imported modules that don't import this one, not even by way of others; without tests."""
    here = str(Path.cwd())
    own = [name for name, file in imported.items() if file.startswith(here) and "site-packages" not in file]
    names = {name: _imports(Path(imported[name]).read_text(encoding="utf-8"), name) for name in own}
    dependent, before = {module}, set[str]()
    while dependent != before:
        before = dependent
        dependent = before | {name for name in own if names[name] & before}
    return [name for name in imported if name not in dependent and not name.startswith(("test", "__main__"))]


def _imports(source: str, module: str) -> set[str]:
    """All names that a module's source may import, with the packages around them."""
    found = {module.rpartition(".")[0]}
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {name.name for name in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {f"{node.module}.{name.name}" for name in node.names}
    return {".".join(name.split(".")[:n]) for name in found for n in range(1, name.count(".") + 2)}
