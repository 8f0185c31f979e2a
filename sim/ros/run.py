"""The public entry of the engine: run nodes, get a recording."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import rosidl_generator_py  # noqa: F401  (rclpy imports it with the first message: 0.1 s that no run should pay)

from sim.evidence import Ended, Recording
from sim.network import Network
from sim.notebook import interrupt_error, raise_if_outdated, report_failure
from sim.ros.engine.program import Process
from sim.ros.latest import latest
from sim.ros.session import Session
from sim.world import World


def run(
    *nodes: Any,
    companions: Sequence[Any] = (),
    world: str | World | None = None,
    seconds: float | None = None,
    seed: int = 0,
    until: Callable[[Recording], bool] | None = None,
    quiet: bool = False,
    network: Network | None = None,
    expect_error: bool = False,
    order: int | str = 0,
    bag: str | Path | None = None,
) -> Recording:
    """Run ROS 2 nodes in simulated time, and return the evidence of what they did.

    nodes: Node classes, functions that return a Node or a Process, main() functions, `Process` objects, or
        launch files: the words after `ros2 launch`, a path, or a LaunchDescription. All run side by side, as
        programs of their own; what one raises or hangs in is in the recording and never raised here.
    companions: further programs, started before these: the recording knows whose nodes are whose.
    world: name of a world or a World, with a robot in it that subscribes to /cmd_vel; None for no robot.
    seconds: simulated time at which the run ends at the latest; by default 10, or all of a bag.
    seed: for the sensors' noise, and for `random` and numpy's generators in the nodes.
    until: called with the recording so far whenever time is about to move on; True ends the run.
    quiet: don't show what the nodes log and print.
    network: what lies between programs of different hosts, such as Network(loss=0.2, delay=0.05); None for
        nothing. The robot and companions are on "robot", and all else is on "laptop", unless `Process` says
        so.
    expect_error: the programs fail on purpose. Otherwise the first error in them, or why they got stuck, is
        shown at the end in a notebook or a terminal, also with `quiet`.
    order: 0 for the usual order of what happens at the same time. Any other number, or a string such as
        "k3f9", names another order that is possible on a robot: of callbacks, programs and messages.
    bag: in place of a world: the folder of a recording that `ros2 bag` made, or one file of it. Its messages
        are published when they were recorded, with the QoS that they had, and all clocks show that time.

    Equal nodes, world, seed and order give equal recordings. Raises TypeError or ValueError for arguments
    that can't be run, WorldError or BagError for a bad world or bag, KeyboardInterrupt when the user
    interrupts; in a notebook OutdatedCodeError, when a node's cell has failed since, or was changed and not
    run.
    """
    raise_if_outdated(nodes)
    more: dict[str, Any] = {"companions": companions, "network": network, "order": order}
    session = Session(nodes, world, seconds, seed, until, quiet, **more, bag=bag)
    latest.recording = session.recording
    session.advance()
    if session.interrupted:
        raise interrupt_error()
    if not expect_error:
        report_failure(session.recording)
    return session.recording


__all__ = ["Ended", "Process", "run"]
