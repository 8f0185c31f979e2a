"""Corrects what was typed in terminals, for a lenient run: set-up lines that are missing, and typos."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from sim.ros2.domains import COURSE_DOMAIN
from sim.ros2.typed_lines import Line
from sim.suggestions import closest_match

DOMAIN = f"export ROS_DOMAIN_ID={COURSE_DOMAIN}"
SET_UP = ("cd ws", "colcon build", "source install/setup.bash", DOMAIN, "cd ..")
COMMANDS = """
    ros ros2 colcon build source export sleep cd run launch topic service node param interface pkg pub echo hz
    list info show call set get type find once times rate executables args cmd_vel logbook true false data
    std_msgs std_srvs msg srv String SetBool Bool Twist ROS_DOMAIN_ID ROS_AUTOMATIC_DISCOVERY_RANGE
    LOCALHOST install setup bash local_setup packages select badge create type ament_python name dependencies
    license Apache rclpy lantern shine
"""
NAME = re.compile(r"[A-Za-z_]\w{2,}")
ALIKE = 0.66
OF_A_SHELL = re.compile(r"\s*(?:&&|;)\s*")
OTHER_DOMAIN = re.compile(r"(?<=ROS_DOMAIN_ID=)\d+")
LEFT_OUT = re.compile(r"\s*(?:\|.*|&|\$HOME/)\s*$")


def corrected(lines: Iterable[Line], prefix: Path) -> Iterator[Line]:
    """Yield the lines with each terminal set up first, one command on each, and known names for typos.

    The robot is left out, because a run has one. prefix: the install prefix, for names in its packages.
    """
    words = set(NAME.findall(COMMANDS)).union(*(NAME.findall(text) for text in _texts(prefix)))
    known: set[str] = set()
    for line in lines:
        if re.match(r"python\S* -m sim\b", line.text):
            continue
        if line.terminal not in known:
            known.add(line.terminal)
            yield from (line._replace(text=text) for text in SET_UP)
        for part in OF_A_SHELL.split(line.text):
            part = OTHER_DOMAIN.sub(str(COURSE_DOMAIN), LEFT_OUT.sub("", part))
            yield line._replace(text=NAME.sub(lambda found: _known(found[0], words), part))


def _known(name: str, words: set[str]) -> str:
    return name if name in words else closest_match(name, sorted(words), ALIKE) or name


def _texts(prefix: Path) -> Iterator[str]:
    files = itertools.chain(prefix.rglob("*.py"), prefix.glob("lib/*/*"))
    yield from (f"{file.stem} {file.read_text('utf-8', 'replace')}" for file in files if file.is_file())
