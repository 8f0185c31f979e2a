"""The simulated time of a run: all ROS clocks at once, and the next moment at which something is due."""

from __future__ import annotations

import weakref
from bisect import bisect
from time import time_ns
from typing import Any

from rclpy.clock import ROSClock
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.time import Time

from sim.nanoseconds import EPOCH, Nanoseconds
from sim.ros.fibers.scheduler import Scheduler

RCLError = _rclpy.RCLError


class SimulatedTime:
    """Sets the time on rclpy's clocks directly: a /clock message would switch nodes one by one, and late."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._handles: dict[weakref.ref[ROSClock], Any] = {}  # of the clocks that are still there
        self._wall: list[int] = [time_ns()]  # when time was moved to each of _moments
        self._moments: list[Nanoseconds] = [0]
        self.clock = ROSClock()  # for timers whose own clock can't be set
        self.adopt(self.clock)

    def adopt(self, clock: ROSClock) -> None:
        """Let this ROS clock show the run's time."""
        with clock.handle:
            clock.handle.set_ros_time_override(Time(nanoseconds=EPOCH + self._scheduler.now)._time_handle)
            clock.handle.set_ros_time_override_is_enabled(True)
        self._handles[weakref.ref(clock, self._handles.pop)] = clock.handle

    def shown_by(self, clock: Any) -> bool:
        """Whether a clock shows the run's time."""
        return weakref.ref(clock) in self._handles

    def move_to(self, moment: Nanoseconds) -> None:
        """Let it be `moment` everywhere."""
        self._scheduler.now = moment
        self._wall.append(time_ns())
        self._moments.append(moment)
        time = Time(nanoseconds=EPOCH + moment)._time_handle
        for handle in list(self._handles.values()):  # a clock may go meanwhile
            handle.set_ros_time_override(time)

    def moment_at(self, wall: int) -> Nanoseconds:
        """What time it was in the run at a time of the wall clock, in nanoseconds."""
        return self._moments[bisect(self._wall, wall) - 1]

    def next_moment(self, end: Nanoseconds) -> Nanoseconds:
        """The next time at which a fiber wakes or a timer of a spinning executor is due; `end` at the latest.

        To stop at every due time matters: a timer that is passed over drops its ticks.
        """
        now, moment = self._scheduler.now, end
        for fiber in self._scheduler.fibers:
            if fiber.wake_at is not None and now < fiber.wake_at < moment:
                moment = fiber.wake_at
            if fiber.spins is None:
                continue
            for timer in fiber.spins.scan.timers:
                try:
                    handle = timer.handle
                    left = None if handle.is_timer_canceled() else handle.time_until_next_call()
                except (InvalidHandle, RCLError):  # destroyed, and not yet taken out of the plan
                    continue
                if left is not None and 0 < left < moment - now:
                    moment = now + left
        return moment
