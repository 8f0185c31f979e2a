"""ROS domains of this machine: the one that is asked for, and those in which somebody is."""

from __future__ import annotations

import os
import re
from pathlib import Path

from sim.ros2.system import Wrong

LAST_DOMAIN = 232  # with a greater one ports would be greater than there are
FIRST_PORT, PORTS, UNICAST = 7400, 250, 10  # DDSI-RTPS 9.6.1.1: where a domain's sockets are
FIRST_ANY_PORT = 32768  # from here on Linux gives ports to whoever asks
_SOCKETS = Path("/proc/net/udp")


def chosen() -> int:
    """The domain that the environment names. Raises Wrong for one that can't be."""
    word = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not word.isdecimal() or int(word) > LAST_DOMAIN:
        raise Wrong(
            f"ROS_DOMAIN_ID is {word!r}, and a domain is a whole number from 0 to {LAST_DOMAIN}:"
            " export ROS_DOMAIN_ID=42"
        )
    return int(word)


def _used_ports() -> set[int]:
    """The UDP ports that processes of this machine listen at."""
    try:
        lines = _SOCKETS.read_text().splitlines()[1:]
    except OSError:
        return set()
    return {int(match[1], 16) for line in lines if (match := re.search(r":([0-9A-F]{4}) ", line))}


def ports(domain: int) -> set[int]:
    """The sockets of participants of a domain on this machine; each has two."""
    first = FIRST_PORT + PORTS * domain
    return {port for port in _used_ports() if first + UNICAST <= port < first + PORTS}


def here() -> set[int]:
    """The domains in which somebody on this machine is."""
    used = {port for port in _used_ports() if FIRST_PORT <= port < FIRST_ANY_PORT}
    return {(port - FIRST_PORT) // PORTS for port in used if (port - FIRST_PORT) % PORTS >= UNICAST}


def note(domain: int) -> str:
    """What to say where nobody is on this domain: who is on another, or what to do if nobody is."""
    others = sorted(here() - {domain})
    if not others:
        return (
            f"Nobody is on ROS domain {domain} of this machine: start a node in another terminal, with"
            f" ROS_DOMAIN_ID={domain}"
        )
    there = " and ".join(str(other) for other in others)
    hint = f"To speak with them: export ROS_DOMAIN_ID={others[-1]}"
    if others == [0]:
        hint += " (runs in notebooks are there, too, and hear nobody)"
    return f"Nobody is on ROS domain {domain} of this machine; there are nodes on {there}. {hint}"
