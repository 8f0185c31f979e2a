"""Preemption of threads between two statements of the student's code, in another order than the usual one.

All fibers share one thread, so one is preempted where its code says so. For the time of a run, a call is
inserted before each statement of the student's functions; lines and tracebacks stay as they are.
"""

from __future__ import annotations

import builtins
import contextlib
import linecache
import sys
from collections.abc import Iterable, Iterator, Sequence
from types import CodeType, FunctionType
from typing import Any

from sim.ros.engine.access_log import AccessLog
from sim.ros.engine.own_code import OwnCode, new_functions
from sim.ros.engine.points import POINT, source_of
from sim.ros.fibers.scheduler import Scheduler, engine
from sim.ros.recorder.running import callback_name

COMPILED = "it is compiled"


def point(line: int) -> None:
    """Called before the statement at this line of a student's function: here its thread may be preempted.

    It is also called after a statement that writes, with the negative line.
    """
    run = engine()
    if run is None or run.preemption is None or run.current.process.from_course:
        return
    log = run.preemption.log
    if line > 0 and run.choices is not None and run.current.process.fibers_alive > 1:
        run.preemption.add_imported()
        if log is None:
            run.preemption_point(sys._getframe(1).f_code.co_qualname, line)
        else:
            log.add_gap(run, sys._getframe(1), line)
    if log is not None:
        log.add(run, sys._getframe(1), line)


class Observer:
    """A search's observations of its runs, all of which have the same programs.

    unseen: code of the programs that has no points, and why, if a program had threads. logs: whether runs
    have a log. log: that of the last one.
    """

    def __init__(self) -> None:
        self.unseen: dict[str, str] = {}
        self.logs = False
        self.log = AccessLog()
        self._own: dict[tuple[int, ...], tuple[Sequence[Any], OwnCode]] = {}

    def own_code(self, targets: Sequence[Any]) -> OwnCode:
        """The code of these programs, which is looked for once."""
        key = tuple(map(id, targets))
        if key not in self._own:
            self._own[key] = targets, OwnCode(targets)
        return self._own[key][1]

    @contextlib.contextmanager
    def active(self) -> Iterator[None]:
        """In this block it observes all runs."""
        global _observer
        before, _observer = _observer, self
        try:
            yield
        finally:
            _observer = before


_observer: Observer | None = None
_taking: set[Preemption] = set()  # those whose runs do something at a point: they have threads or a log


def _set_point() -> None:
    """Let the inserted calls do something only if a run needs it: most programs have one thread."""
    # A function in C takes next to no time. Like `point` it returns None: see the lambdas in points.py.
    builtins.__dict__[POINT] = point if _taking else set[int]().discard


class Preemption:
    """The student's functions of one run, each with calls of `point` between `begin` and `end`.

    Create it before the run starts.
    """

    def __init__(self, targets: Sequence[Any]) -> None:
        observer = _observer or Observer()
        self._observer, self._own = observer, observer.own_code(targets)
        self._originals: list[tuple[FunctionType, CodeType]] = []
        self._unseen = dict.fromkeys(self._own.compiled, COMPILED)
        self._modules, self._threads = 0, False
        self.log = AccessLog() if observer.logs else None

    @staticmethod
    def is_needed(order: str) -> bool:
        """Return whether a run in this order has preemptions or a log."""
        return bool(order) or (_observer is not None and _observer.logs)

    def begin(self) -> None:
        """Give the functions their points."""
        _set_point()
        if self.log is not None:
            self._take_points()
        for filename in {function.__code__.co_filename for function in self._own.functions}:
            linecache.checkcache(filename)
        self._add(self._own.functions)
        self._modules = len(sys.modules)

    def thread_started(self) -> None:
        """A program has a second thread from now on: from here on its preemptions matter."""
        if not self._threads:
            self._threads, self._modules = True, 0
            self._take_points()
        self.add_imported()

    def add_imported(self) -> None:
        """Give points to what was created since the run began, if modules have been imported meanwhile."""
        if len(sys.modules) != self._modules:
            self._modules = len(sys.modules)
            self._add(new_functions())

    def end(self, run: Scheduler) -> None:
        """Give the functions their own code again."""
        _taking.discard(self)
        _set_point()
        for function, code in self._originals:
            function.__code__ = code
        self._originals.clear()
        if self._threads:
            self._observer.unseen |= self._unseen
        if self.log is not None:
            self.log.finish(run)
            self._observer.log = self.log

    def _take_points(self) -> None:
        _taking.add(self)
        _set_point()

    def _add(self, functions: Iterable[FunctionType]) -> None:
        for function in functions:
            code = function.__code__
            found = source_of(code).with_points(code)
            if found is code:
                continue
            if isinstance(found, CodeType):
                self._originals.append((function, code))
                function.__code__ = found
            elif not function.__name__.startswith("__"):  # such as what a dataclass generates
                self._unseen[callback_name(function)] = found
