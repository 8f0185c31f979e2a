"""Measures over the nodes themselves: do they run, what are they called, which timers have they got."""

from __future__ import annotations

import math

from grader.checks.check import Missed
from grader.diagnosis import find_fault
from sim.evidence import Recording, TimerInfo
from sim.suggestions import closest_ros_name, describe_difference


def no_errors(recording: Recording) -> None:
    """The code runs to the end without an error, hang or deadlock. Raises Missed with what happened."""
    fault = find_fault(recording)
    if fault:
        raise Missed(fault.expected, fault.saw, fault.hint)


def named(recording: Recording, name: str) -> None:
    """There is a node of this full name, e.g. "/talker". Raises Missed with the names that there are."""
    if name in recording.graph.nodes:
        return
    near = closest_ros_name(name, recording.graph.nodes)
    default = "Set the node's name with super().__init__('name')."
    hint = describe_difference(near, name) if near else default
    typo = ("__node", name.rpartition("/")[2]) if near else None
    raise Missed(f"a node called {name}", ", ".join(recording.graph.nodes) or "no node", hint, typo=typo)


def has_timer(recording: Recording, period: float, *, tolerance: float = 1e-3) -> list[TimerInfo]:
    """The timers with a period in seconds. Raises Missed with those that there are."""
    found = [
        timer for timer in recording.graph.timers if math.isclose(timer.period, period, rel_tol=tolerance)
    ]
    if found:
        return found
    others = ", ".join(f"every {timer.period:g} s" for timer in recording.graph.timers)
    hint = f"self.create_timer({period:g}, self.callback) calls a method every {period:g} s."
    raise Missed(f"a timer every {period:g} s", others or "no timer", hint)
