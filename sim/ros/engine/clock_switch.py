"""Whether a ROS clock goes by /clock, as `use_sim_time` has it; in a run all show the run's time anyway."""

from __future__ import annotations

import weakref

from rclpy.clock import ClockChange, JumpHandle


class ClockSwitch:
    """The switch of one clock, and who is told when it is turned. `on` from the moment at which it is."""

    def __init__(self) -> None:
        self.on = False
        self._told: list[weakref.ref[JumpHandle]] = []  # in the order in which they asked for it

    def tell(self, handle: JumpHandle) -> None:
        """Call its callbacks from now on, for as long as somebody keeps it."""
        self._told.append(weakref.ref(handle, self._told.remove))

    def forget(self, handle: JumpHandle) -> None:
        """Call them no more."""
        self._told.remove(weakref.ref(handle))

    def turn(self, on: bool) -> None:
        """Set the switch. All are called before and after, as rcl does it, unless it is set so already."""
        if on == self.on:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if on else ClockChange.ROS_TIME_DEACTIVATED
        handles = [handle for told in self._told if (handle := told()) is not None]
        for handle in handles:
            if handle._pre_callback is not None:
                handle._pre_callback()
        self.on = on
        for handle in handles:
            if handle._post_callback is not None:
                handle._post_callback({"clock_change": change, "delta": 0})
