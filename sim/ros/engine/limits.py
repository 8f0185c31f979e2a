"""How much a program may do before time has to move on, and in a second; more is a livelock."""

from __future__ import annotations

from sim.nanoseconds import SECOND
from sim.ros.fibers.fiber import Program
from sim.ros.fibers.scheduler import CALL_COST, Scheduler

MAX_CALLBACKS_PER_INSTANT = 20_000
# Callbacks and waits of one program in a simulated second. Measured: rclpy's own executor calls a timer that
# publishes 5700 times in a second of computing, so that on a robot no program has more for long.
MAX_PACE = 5_000
MAX_AHEAD = 20_000  # so many more, before that counts as long
LOOK_AFTER = 1_000  # callbacks and switches
FREE_REQUESTS = 1_000  # in a row that take no time, of a loop that is in no callback


class RunLimits:
    """The limits of one run.

    pace: callbacks and waits in a simulated second that a program may have for long.
    """

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._callbacks = self._callbacks_before = 0
        self.pace = MAX_PACE
        self._second, self._look_at = 0, 0  # the simulated second under way; the work at which to look again
        self._requests: dict[Program, int] = {}  # by program, those that time has passed for included
        self._counted: dict[Program, int] = {}  # the steps of each program until then that its pace allows

    @property
    def work(self) -> int:
        """Changes whenever control passes on: the guard sees by it that student code isn't stuck."""
        return self._scheduler.switches + self._callbacks

    def relax_pace(self, times: int) -> None:
        """Multiply the pace: a program represents another process, which has a limit of its own."""
        self.pace *= times

    def begin_moment(self) -> None:
        """Start a new time step: reset the count of its callbacks."""
        self._callbacks_before = self._callbacks

    def count_request(self) -> None:
        """A request or goal is about to be sent. A loop outside callbacks that sends many makes progress."""
        fiber, now = self._scheduler.current, self._scheduler.now
        if not fiber.callbacks:
            paid = now // CALL_COST
            self._requests[fiber.process] = sent = max(self._requests.get(fiber.process, 0), paid) + 1
            if sent > FREE_REQUESTS + paid:
                self._scheduler.wait("a response", until=now + CALL_COST)

    def count_callback(self) -> None:
        """A callback is about to run. Raises Livelock when too many ran without time moving."""
        if self._callbacks - self._callbacks_before >= MAX_CALLBACKS_PER_INSTANT:
            self._scheduler.raise_livelock(
                f"{MAX_CALLBACKS_PER_INSTANT} callbacks ran at t = {self._scheduler.now / SECOND:g} s "
                "without letting time advance"
            )
        self._callbacks += 1  # not before: the guard must see that code which swallows the Livelock is stuck
        fiber = self._scheduler.current
        fiber.process.steps += 1
        fiber.calls.pop("messages", None)  # one each that answer each other are no loop of this callback's

    def check_pace(self) -> None:
        """Raise Livelock when time moves, but a program does so much in it that the run would hardly end."""
        second = self._scheduler.now // SECOND
        if second == self._second and self.work < self._look_at:
            return
        self._look_at = self.work + LOOK_AFTER
        passed, self._second = second - self._second, second
        for program in {fiber.process: None for fiber in self._scheduler.fibers}:
            counted = self._counted.get(program, 0)
            if passed:
                self._counted[program] = counted = min(program.steps, counted + passed * self.pace)
            if program.steps - counted > self.pace + MAX_AHEAD:
                self._scheduler.raise_livelock(
                    f"{program.name} had more than {self.pace} callbacks or waits a second, faster than "
                    f"rclpy is on a robot, until t = {self._scheduler.now / SECOND:g} s; a timer's period or "
                    "a sleep is far too short"
                )
