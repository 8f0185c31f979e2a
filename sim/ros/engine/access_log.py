"""A log of what the student's functions read, write and call in one run, from which a race is explained."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from types import BuiltinFunctionType, FrameType, ModuleType
from typing import Any, NamedTuple

from sim.evidence import since_start
from sim.nanoseconds import SECOND
from sim.ros.engine.points import CALL, source_of
from sim.ros.fibers.choices import label
from sim.ros.fibers.fiber import Fiber
from sim.ros.fibers.scheduler import Scheduler
from sim.ros.recorder.tracebacks import student_line

MOST_ACCESSES = 200_000
LONGEST_VALUE = 60
PLAIN = (type(None), bool, int, float, str, bytes)
CONTAINERS = (list, dict, set, tuple, frozenset, deque)
CODE = (type, ModuleType, BuiltinFunctionType)
MISSING, NO_DATA = object(), object()


class Logged(NamedTuple):
    """One access to an attribute of an object, or to a name that functions share.

    thread: that of which program. function, line: where it was. kind: READ, WRITE or CALL. owner: the class
    of the object, or ""; number: which object it was. value: what it is, after a write; the method of a call.
    """

    stamp: float
    thread: tuple[str, int]
    function: str
    line: int
    kind: str
    owner: str
    number: int
    name: str
    value: str

    @property
    def what(self) -> tuple[str, int, str]:
        """The attribute or name."""
        return self.owner, self.number, self.name


@dataclass
class Gap:
    """A preemption of a thread in a function: the accesses from `begin` to `end` happened meanwhile.

    planned: what it was about to do; without values.
    """

    thread: tuple[str, int]
    function: str
    begin: int
    planned: list[Logged]
    end: int | None = None


class AccessLog:
    """The log of one run."""

    def __init__(self) -> None:
        self.accesses: list[Logged] = []
        self.gaps: list[Gap] = []
        self.stopped: list[str] = []  # which threads waited at the end, and where
        self._objects: dict[int, tuple[int, Any]] = {}

    def add(self, run: Scheduler, frame: FrameType, line: int) -> None:
        """Note what is read and called before, or was written, at this line of this frame."""
        if len(self.accesses) < MOST_ACCESSES:
            self.accesses += self._accesses(run, frame, line)

    def add_gap(self, run: Scheduler, frame: FrameType, line: int) -> None:
        """Let the current fiber reach a preemption point, and note its preemption."""
        planned = list(self._accesses(run, frame, line, -line))
        gap = Gap(_thread(run.current), _function(frame), len(self.accesses), planned)
        self.gaps.append(gap)
        if run.preemption_point(frame.f_code.co_qualname, line):
            gap.end = len(self.accesses)
        else:
            self.gaps.remove(gap)

    def _accesses(self, run: Scheduler, frame: FrameType, *lines: int) -> Iterator[Logged]:
        known = source_of(frame.f_code).accesses
        found = [access for line in lines for access in known.get(line, ())]
        names = frame.f_locals if found else {}
        for kind, base, name, method in found:
            owner = names.get(base, frame.f_globals.get(base)) if base else None
            value = _value(owner, name) if base else names.get(name, frame.f_globals.get(name, MISSING))
            if value is not NO_DATA:
                number, _ = self._objects.setdefault(id(owner), (len(self._objects), owner))
                where = run.now / SECOND, _thread(run.current), _function(frame), abs(lines[0])
                owned = type(owner).__name__ if base else ""
                text = f"{method}()" if kind == CALL else "" if len(lines) > 1 else _text(value)
                yield Logged(*where, kind, owned, number, name, text)

    def finish(self, run: Scheduler) -> None:
        """Note which threads wait without a time limit; a program has failed, or the run is about to end."""
        if self.stopped:
            return
        for fiber in run.fibers:
            forever = fiber.started and not fiber.done and fiber.wake_at is None and fiber.waiter is None
            where = student_line(fiber.greenlet.gr_frame) if forever else ""
            if where and not fiber.process.from_course:
                line, _, source = where.removeprefix(", at ").partition(": ")
                self.stopped.append(f"{label(fiber)} still waits at {line}: `{source}`")


def _thread(fiber: Fiber) -> tuple[str, int]:
    return fiber.process.key, fiber.number


def _function(frame: FrameType) -> str:
    return frame.f_code.co_qualname.rpartition("<locals>.")[2]


def _value(owner: Any, name: str) -> Any:
    """The value of an attribute, without asking the object: MISSING without one, NO_DATA for a method."""
    try:
        found = object.__getattribute__(owner, "__dict__").get(name, MISSING)
    except Exception:
        return NO_DATA
    if found is MISSING:
        classes = [vars(base) for base in type(owner).__mro__]
        found = next((names[name] for names in classes if name in names), MISSING)
        if found is MISSING and any("__getattr__" in names for names in classes):
            return NO_DATA
    return NO_DATA if hasattr(type(found), "__get__") or type(found) in CODE else found


def _text(value: Any) -> str:
    """A value as the story shows it; objects of a student's class are only named."""
    kind = type(value)
    if value is MISSING:
        return "nothing"
    if kind in CONTAINERS:
        return f"a {kind.__name__} of {len(value)}"
    if kind in PLAIN or "_fields_and_field_types" in vars(kind):  # a message
        text = repr(value)
        text = text if kind in PLAIN else text[text.find(f"{kind.__name__}(") :]
        if len(text) <= LONGEST_VALUE:
            return text
        stamp = getattr(getattr(value, "header", None), "stamp", None)
        if stamp is not None:
            return f"a {kind.__name__} with stamp {since_start(stamp):.4g} s"
    return f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"
