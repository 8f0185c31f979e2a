"""The choices of a run in another order than the usual one: what the programs' code does not fix."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from sim.evidence import Departure
from sim.nanoseconds import SECOND, Nanoseconds, nanoseconds
from sim.order import Draw, Order
from sim.ros.fibers.fiber import Fiber, Program

MOST_PREEMPTIONS = 8  # in a run: almost all known faults need one or two
MOST_DEPARTURES = 20_000  # that are listed
PICKED_LINES = 1.2  # times the intensity: the share of lines before which threads may be preempted
LATE_VISITS = 300  # executions of a line before which it may begin at the latest
FIRST, USUAL, LAST = -1, 0, 1


class Choices:
    """Makes the choices of one run, and lists those that depart from the usual order.

    departures: the list to fill. now: returns the simulated time.
    """

    def __init__(self, order: Order, departures: list[Departure], now: Callable[[], Nanoseconds]) -> None:
        self.order = order
        self._departures, self._now = departures, now
        self._preemptions = 0
        self._longest = nanoseconds(2 * order.spread)  # that a thread is preempted
        self._listed: set[tuple[Nanoseconds, str]] = set()
        self._earliest: dict[tuple[Any, ...], float] = {}

    def note_departure(self, draw: Draw, node: str, kind: str, text: str) -> None:
        """A choice departs from the usual one. Each is listed once at a time."""
        now = self._now()
        if (now, draw.id) not in self._listed and len(self._departures) < MOST_DEPARTURES:
            self._listed.add((now, draw.id))
            self._departures.append(Departure(now / SECOND, node, kind, text, draw.id))

    def rank(self, draw: Draw, probability: float) -> int:
        """Return whether something comes first, last or in its usual place."""
        if not self.order.departs(draw, probability):
            return USUAL
        return FIRST if draw.value < 0.5 else LAST

    # -- programs ----------------------------------------------------------------------------------

    def start_delay(self, program: Program) -> Nanoseconds:
        """Return how much later than usual a program starts."""
        return self.order.start(program.number)[1]

    def started_late(self, program: Program) -> None:
        """A program starts now, after its delay."""
        draw, delay = self.order.start(program.number)
        self.note_departure(draw, program.key, "start", f"{program.name} starts {delay / SECOND:.3f} s later")

    def turns(self, fibers: Sequence[Fiber]) -> list[Fiber]:
        """The fibers in the order in which they take their turns in a round.

        The course's programs keep their own order; the student's may come first, and in any order.
        """
        course = [fiber for fiber in fibers if fiber.process.from_course]
        students = [fiber for fiber in fibers if not fiber.process.from_course]
        ready = [fiber for fiber in students if not fiber.done and fiber.runnable()]
        if len(ready) > 1:
            students = self._arranged(students, ready)
        if ready and any(not fiber.done and fiber.runnable() for fiber in course):
            draw = self.order.draw("first", self._now())
            if self.order.departs(draw, self.order.intensity):
                self.note_departure(draw, "", "turn", "the programs under test run before the others")
                return students + course
        return course + students

    def _arranged(self, students: list[Fiber], ready: list[Fiber]) -> list[Fiber]:
        now, intensity = self._now(), self.order.intensity
        draws = {fiber: self.order.draw("turn", now, fiber.process.key, fiber.number) for fiber in ready}
        ranks = {fiber: self.rank(draw, intensity) for fiber, draw in draws.items()}
        arranged = sorted(students, key=lambda fiber: ranks.get(fiber, USUAL))
        places = {fiber: index for index, fiber in enumerate(fiber for fiber in arranged if fiber in ranks)}
        for index, fiber in enumerate(ready):
            passed = [
                label(other)
                for place, other in enumerate(ready)
                if (places[other] - places[fiber]) * (place - index) < 0
            ]
            if ranks[fiber] != USUAL and passed:
                where = "before" if places[fiber] < index else "after"
                text = f"{label(fiber)} runs {where} {' and '.join(passed)}"
                self.note_departure(draws[fiber], fiber.process.key, "turn", text)
        return arranged

    # -- threads -----------------------------------------------------------------------------------

    def preemption(
        self, fiber: Fiber, function: str, line: int, others_due: Callable[[Nanoseconds], bool]
    ) -> Preempted | None:
        """Return how a thread is preempted before it executes a line; None where it isn't.

        An order picks some lines, and for each the time of its execution from which on it may happen there:
        so it reaches what threads do late, too, with few preemptions. others_due: whether anything else would
        happen within a time; otherwise a preemption changes nothing.
        """
        program = fiber.process
        program.visits[function, line] += 1
        visit = program.visits[function, line]
        if self.order.only is None:
            begin = self._earliest_visit(program.key, function, line)
            if visit < begin or self._preemptions >= MOST_PREEMPTIONS:
                return None
        draw, longest = self.order.draw("thread", program.key, function, line, visit), self._longest
        if not self.order.departs(draw, 0.5) or not (self.order.only or others_due(longest)):
            return None
        self._preemptions += 1
        thread, name = label(fiber), function.rsplit("<locals>.", 1)[-1]
        where = "" if name in thread else f" of {name}"
        text = f"{thread} is preempted before line {line}{where}"
        self.note_departure(draw, program.key, "thread", text)
        return Preempted(int(max(0.0, 2 * draw.value - 1) * longest), draw.value < 0.25 and longest)

    def _earliest_visit(self, *line: Any) -> float:
        """From which execution of a line on its thread may be preempted there; infinite where it never is.

        In half of the cases that is the first. Drawn once for each line: a loop passes here a million times,
        and that counts as its computing.
        """
        if line not in self._earliest:
            draw = self.order.draw("line", *line)
            picked = draw.chance < PICKED_LINES * self.order.intensity
            self._earliest[line] = LATE_VISITS ** max(0.0, 2 * draw.value - 1) if picked else math.inf
        return self._earliest[line]


class Preempted(NamedTuple):
    """A thread's preemption.

    wait: until it goes on; 0 is until all others have had a turn. patience: until one of them has done
    something, but at most so long; 0 for not at all.
    """

    wait: Nanoseconds
    patience: Nanoseconds


def label(fiber: Fiber) -> str:
    """Return how a fiber is called: its program; or its thread, or parallel callback, and its program."""
    program = fiber.process.name
    if fiber.thread is None:
        return program
    return f"{fiber.callbacks[0].name if fiber.callbacks else fiber.name} of {program}"
