"""Ends the programs of a run, as Ctrl-C does in their terminals, and what still runs by force."""

from __future__ import annotations

from typing import Any

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.fibers.exceptions import RunOver
from sim.ros.fibers.fiber import Fiber

TIME_TO_END: Nanoseconds = 2 * SECOND  # after Ctrl-C, such as for a pause until the last message is sent


def end_programs(engine: Any) -> None:
    """End all programs of a run that is closed. engine: its `Engine`.

    As on a robot, rclpy's handler of SIGINT shuts rclpy down first, and then KeyboardInterrupt is raised in
    each main thread. Programs then have a little time to end, in which the world does not move.
    """
    for program in engine.programs:
        program.shut_down()
    mains = [fiber for fiber in engine.fibers if fiber.thread is None]
    engine.throw(KeyboardInterrupt, mains)
    _let_end(engine, mains)
    engine.recorder.ending = False
    engine.output.silent = True
    for waiter in list(engine.waiters.all):
        waiter.end_coroutines()
    for _ in range(2):  # twice, for code that swallows the first
        engine.throw(RunOver, engine.fibers)
        engine.finish()


def _let_end(engine: Any, mains: list[Fiber]) -> None:
    """Let these fibers run to their ends; what they wait for is simulated, up to the limit."""
    end = engine.now + TIME_TO_END
    engine.finish()
    while any(not fiber.done for fiber in mains):
        moment = engine.next_moment(end)
        if moment >= end:
            return
        engine.time.move_to(moment)
        engine.limits.begin_moment()
        engine.waiters.wake_polled()
        engine.finish()
