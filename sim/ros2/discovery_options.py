"""The ros2 options that say how a command discovers nodes, and the commands that have them."""

from __future__ import annotations

from sim.ros2.group import Argument, argument, flag

SPIN_TIME = argument(
    "--spin-time", type=float, metavar="N", help="Wait exactly N seconds until nodes have been discovered"
)
SIM_TIME = flag("-s", "--use-sim-time", help="Changes nothing of what this command prints")
NO_DAEMON = flag("--no-daemon", help="Changes nothing: there is no daemon")
# What measures or sends discovers nodes itself, in the official command, too.
DIRECT = {"topic bw", "topic delay", "topic hz", "topic pub"}
ALL = {
    *("lifecycle get", "lifecycle list", "lifecycle nodes", "lifecycle set", "node info", "node list"),
    *(f"param {verb}" for verb in ("delete", "describe", "dump", "get", "list", "load", "set")),
    *("service info", "service list"),
    *("topic echo", "topic find", "topic info", "topic list", "topic type"),
}


def discovery_options(words: str) -> tuple[Argument, ...]:
    """Return the options of a command and its verb, such as "topic echo"."""
    if words in DIRECT:
        return (SPIN_TIME,)
    return (SPIN_TIME, SIM_TIME, NO_DAEMON) if words in ALL else ()
