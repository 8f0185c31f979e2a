"""ROS domains on this machine: the selected one, and those that have participants."""

from __future__ import annotations

import os
import re
from pathlib import Path

from sim.ros2.system import CliError

COURSE_DOMAIN = 42  # of `python -m sim`; not 0, the default of every other ROS process
LAST_DOMAIN = 232  # greater ones would need ports that don't exist
FIRST_PORT, PORTS, UNICAST = 7400, 250, 10  # DDSI-RTPS 9.6.1.1: the ports of a domain
OWNERS = {
    0: " (where runs in notebooks are, too, which no other process reaches)",
    COURSE_DOMAIN: " (the domain of `python -m sim`)",
}
EPHEMERAL = range(32768, 61000)  # ports that Linux assigns to anything: domains 102 to 214 are there, too
_SOCKETS = Path("/proc/net/udp")


def selected_domain() -> int:
    """The domain of ROS_DOMAIN_ID. Raises CliError for an invalid one."""
    text = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not text.isdecimal() or int(text) > LAST_DOMAIN:
        raise CliError(
            f"ROS_DOMAIN_ID is {text!r}, but a domain is a whole number from 0 to {LAST_DOMAIN}: export "
            "ROS_DOMAIN_ID=42"
        )
    return int(text)


def _used_ports() -> set[int]:
    """The UDP ports that are open on this machine."""
    try:
        lines = _SOCKETS.read_text().splitlines()[1:]
    except OSError:
        return set()
    return {int(match[1], 16) for line in lines if (match := re.search(r":([0-9A-F]{4}) ", line))}


def participant_ports(domain: int) -> set[int]:
    """The open ports of a domain's participants on this machine; each participant has two."""
    first = FIRST_PORT + PORTS * domain
    return {port for port in _used_ports() if first + UNICAST <= port < first + PORTS}


def active_domains() -> set[int]:
    """The domains that have participants on this machine, as far as no other domain has their ports."""
    used = {port for port in _used_ports() if port >= FIRST_PORT and port not in EPHEMERAL}
    return {(port - FIRST_PORT) // PORTS for port in used if (port - FIRST_PORT) % PORTS >= UNICAST}


def no_nodes_hint(domain: int) -> str:
    """The hint for a domain without nodes: the domains that have some, the course's first, or what to do.

    The domain 0 comes last: what is there may be runs.
    """
    others = sorted(active_domains() - {domain}, key=lambda other: (other != COURSE_DOMAIN, not other, other))
    none = f"There are no nodes on ROS domain {domain} of this machine"
    if not others:
        return f"{none}: start a node in another terminal, with ROS_DOMAIN_ID={domain}"
    *first, last = (f"{other}{OWNERS.get(other, '')}" for other in others)
    names = f"{', '.join(first)} and {last}" if first else last
    which = "it" if len(others) == 1 else "the first"
    return f"{none}, but on {names}. To use {which}: export ROS_DOMAIN_ID={others[0]}"
