"""rclpy's clocks and timers follow the run's simulated time, whatever `use_sim_time` says."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.clock import Clock, JumpHandle, JumpThreshold, ROSClock, TimeJump
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rclpy.timer import Timer
from rclpy.utilities import get_default_context

from sim.nanoseconds import UPTIME, Nanoseconds
from sim.ros.engine.clock_switch import CLOCK_SWITCH, ClockSwitch
from sim.ros.fibers.scheduler import Scheduler, engine
from sim.ros.hooks.table import hook

ON_SWITCH = JumpThreshold(min_forward=None, min_backward=None, on_clock_change=True)


def _offset(clock: Clock, run: Scheduler) -> Nanoseconds:
    """Return what a clock shows at the start of a run."""
    return UPTIME if clock.clock_type is ClockType.STEADY_TIME else run.epoch


@hook(
    Clock,
    "__new__",
    "a ROS clock made in a run shows its time from the first moment, not 0 until a /clock message comes",
)
def new_clock(original: Callable) -> Callable:
    def __new__(cls: type, **keywords: Any) -> Clock:
        clock = original(cls, **keywords)
        run = engine()
        if run is not None and clock.clock_type is ClockType.ROS_TIME:
            run.time.adopt(clock)
            CLOCK_SWITCH.attach(clock, ClockSwitch())
        return clock

    return __new__


@hook(ROSClock, "set_ros_time_override", "the run moves the time of all its clocks at once")
def set_ros_time_override(original: Callable) -> Callable:
    def set_ros_time_override(self: ROSClock, time: Time) -> None:
        if engine() is not None:
            raise NotImplementedError(
                "set_ros_time_override() can't change the time in a run: all clocks show its simulated time."
            )
        original(self, time)

    return set_ros_time_override


@hook(TimeSource, "attach_clock", "it would set the clock, which shows the run's time already")
def attach_clock(original: Callable) -> Callable:
    def attach_clock(self: TimeSource, clock: ROSClock) -> None:
        if engine() is None or not isinstance(clock, ROSClock):
            original(self, clock)
        else:
            clock._set_ros_time_is_active(self.ros_time_is_active)
            self._associated_clocks.add(clock)

    return attach_clock


@hook(ROSClock, "_set_ros_time_is_active", "jump callbacks are called, and time stays the run's")
def set_ros_time_is_active(original: Callable) -> Callable:
    def _set_ros_time_is_active(self: ROSClock, enabled: bool) -> None:
        switch = CLOCK_SWITCH.find(self)
        if engine() is None or switch is None:
            original(self, enabled)
        else:
            switch.set(enabled)

    return _set_ros_time_is_active


@hook(ROSClock, "ros_time_is_active", "rcl returns true for each clock that shows the run's time")
def ros_time_is_active(original: Any) -> property:
    def ros_time_is_active(self: ROSClock) -> bool:
        switch = CLOCK_SWITCH.find(self)
        return original.fget(self) if engine() is None or switch is None else switch.on

    return property(ros_time_is_active)


@hook(JumpHandle, "__init__", "in a run time passes, as on a robot, and never jumps, whatever a step is")
def jump_handle_init(original: Callable) -> Callable:
    def __init__(self: JumpHandle, *, clock: Clock, threshold: JumpThreshold, **callbacks: Any) -> None:
        original(self, clock=clock, threshold=threshold, **callbacks)
        if engine() is not None:
            self.unregister()  # rcl would call it from outside student code, and after its destruction
            switch = CLOCK_SWITCH.find(clock)
            if switch is not None and threshold.on_clock_change:
                switch.add(self)
                CLOCK_SWITCH.attach(self, switch)

    return __init__


@hook(JumpHandle, "unregister", "the run calls the callbacks for a switch")
def unregister(original: Callable) -> Callable:
    def unregister(self: JumpHandle) -> None:
        switch = CLOCK_SWITCH.detach(self)
        if switch is not None:
            switch.remove(self)
        original(self)

    return unregister


@hook(Clock, "now", "steady and system clocks show simulated time too, and waiting in a busy loop takes time")
def now(original: Callable) -> Callable:
    def now(self: Clock) -> Time:
        run = engine()
        if run is None:
            return original(self)
        run.count_call("looks at a clock")
        return Time(nanoseconds=run.now + _offset(self, run), clock_type=self.clock_type)

    return now


@hook(Clock, "sleep_until", "it waits in C++, which neither simulated time nor an interrupt would end")
def sleep_until(original: Callable) -> Callable:
    def sleep_until(self: Clock, until: Time, context: Context | None = None) -> bool:
        run = engine()
        if run is None:
            return original(self, until, context)
        context = context or get_default_context()
        if not context.ok():
            raise NotInitializedException()
        if until.clock_type != self.clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        wake = until.nanoseconds - _offset(self, run)
        switched: list[TimeJump] = []
        with self.create_jump_callback(ON_SWITCH, post_callback=switched.append):
            if run.now < wake:
                run.wait("a clock's sleep", ready=lambda: switched or not context.ok(), until=wake)
        return run.now >= wake and not switched

    return sleep_until


@hook(Timer, "__init__", "timers on steady, system or unattached clocks follow simulated time too")
def timer_init(original: Callable) -> Callable:
    def __init__(
        self: Timer, callback: Any, callback_group: Any, timer_period_ns: int, clock: Clock, **keywords: Any
    ) -> None:
        run = engine()
        if run is None or run.time.shown_by(clock):
            return original(self, callback, callback_group, timer_period_ns, clock, **keywords)
        original(self, callback, callback_group, timer_period_ns, run.time.clock, **keywords)
        self._clock = clock
        return None

    return __init__
