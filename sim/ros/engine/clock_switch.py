"""Whether a ROS clock follows /clock, as `use_sim_time` says; in a run all show the run's time anyway."""

from __future__ import annotations

import weakref

from rclpy.clock import ClockChange, JumpHandle

from sim.ros.attached import Attached


class ClockSwitch:
    """The switch of one clock, and the jump callbacks for its changes. `on`: what it is set to."""

    def __init__(self) -> None:
        self.on = False
        self._handles: list[weakref.ref[JumpHandle]] = []  # in the order of their creation

    def add(self, handle: JumpHandle) -> None:
        """Call its callbacks from now on, for as long as it exists."""
        self._handles.append(weakref.ref(handle, self._handles.remove))

    def remove(self, handle: JumpHandle) -> None:
        """Call them no more."""
        self._handles.remove(weakref.ref(handle))

    def set(self, on: bool) -> None:
        """Set the switch. All are called before and after, as rcl does it, unless it is set so already."""
        if on == self.on:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if on else ClockChange.ROS_TIME_DEACTIVATED
        handles = [handle for known in self._handles if (handle := known()) is not None]
        for handle in handles:
            if handle._pre_callback is not None:
                handle._pre_callback()
        self.on = on
        for handle in handles:
            if handle._post_callback is not None:
                handle._post_callback({"clock_change": change, "delta": 0})


CLOCK_SWITCH = Attached[ClockSwitch]()  # of a ROSClock and of a JumpHandle
