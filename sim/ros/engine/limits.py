"""How much student code may do before time has to move on; what does more is a livelock."""

from __future__ import annotations

from sim.nanoseconds import SECOND
from sim.ros.fibers.scheduler import Scheduler

MAX_CALLBACKS_PER_INSTANT = 20_000
MAX_WORK_PER_SECOND = 200_000  # callbacks and switches in a simulated second


class Limits:
    """Those of one run."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._callbacks = self._callbacks_before = 0
        self._second = (0, 0)  # when the second under way began, and the work done by then

    @property
    def work(self) -> int:
        """Changes whenever control passes on: the guard sees by it that student code isn't stuck."""
        return self._scheduler.switches + self._callbacks

    def begin_moment(self) -> None:
        """Time was moved: callbacks are counted anew."""
        self._callbacks_before = self._callbacks

    def count_callback(self) -> None:
        """A callback is about to run. Raises Livelock when too many ran without time moving."""
        if self._callbacks - self._callbacks_before >= MAX_CALLBACKS_PER_INSTANT:
            self._scheduler.refuse_to_go_on(
                f"{MAX_CALLBACKS_PER_INSTANT} callbacks ran at t = {self._scheduler.now / SECOND:g} s"
                " without letting time move on"
            )
        self._callbacks += 1  # not before: the guard must see that code which swallows the Livelock is stuck

    def check_pace(self) -> None:
        """Raise Livelock when time moves, but in steps so small that the run would never end."""
        scheduler, (began, work) = self._scheduler, self._second
        if scheduler.now - began >= SECOND:
            self._second = scheduler.now, self.work
        elif self.work - work > MAX_WORK_PER_SECOND:
            scheduler.refuse_to_go_on(
                f"callbacks and waits came more than {MAX_WORK_PER_SECOND} times in one second, near "
                f"t = {scheduler.now / SECOND:g} s; a timer's period or a sleep is far too short"
            )
