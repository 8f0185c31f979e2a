"""The simulated time of a run, on all ROS clocks at once."""

from __future__ import annotations

import weakref
from bisect import bisect
from time import time_ns
from typing import Any

from rclpy.clock import ROSClock
from rclpy.time import Time

from sim.nanoseconds import Nanoseconds
from sim.ros.fibers.scheduler import Scheduler


class SimulatedTime:
    """Sets the time on rclpy's clocks directly: a /clock message would switch nodes one by one, and late."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._handles: dict[weakref.ref[ROSClock], Any] = {}  # of the clocks that exist
        self._wall: list[int] = [time_ns()]  # when time was moved to each of _moments
        self._moments: list[Nanoseconds] = [0]
        self.clock = ROSClock()  # for timers whose own clock can't be set
        self.adopt(self.clock)

    def adopt(self, clock: ROSClock) -> None:
        """Make this ROS clock show the run's time."""
        now = self._scheduler.epoch + self._scheduler.now
        with clock.handle:
            clock.handle.set_ros_time_override(Time(nanoseconds=now)._time_handle)
            clock.handle.set_ros_time_override_is_enabled(True)
        self._handles[weakref.ref(clock, self._handles.pop)] = clock.handle

    def shown_by(self, clock: Any) -> bool:
        """Return whether a clock shows the run's time."""
        return weakref.ref(clock) in self._handles

    def move_to(self, moment: Nanoseconds) -> None:
        """Set the time of the run and of all its clocks."""
        self._scheduler.now = moment
        self._wall.append(time_ns())
        self._moments.append(moment)
        time = Time(nanoseconds=self._scheduler.epoch + moment)._time_handle
        for handle in list(self._handles.values()):  # a clock may be destroyed meanwhile
            handle.set_ros_time_override(time)

    def moment_at(self, wall: int) -> Nanoseconds:
        """Return what time it was in the run at a time of the wall clock, in nanoseconds."""
        return self._moments[bisect(self._wall, wall) - 1]
