"""What was typed in the terminals of a run, as they show it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from grader.checks.check import Missed
from sim.evidence import Recording

# What to do about it, by what the terminal shows of a line that failed.
HINTS = {
    "needs a shell": "The lines are marked without a shell: write one command on each, and nothing else.",
    "has to be closed": "End a value in quotes with the same quote that it begins with.",
    "command not found": "Check the first word of that line, letter by letter.",
    "it is not built|colcon build makes it": "Type colcon build in ws first, and then source what it built.",
    "it was built later": "Source install/setup.bash once more: a terminal knows what was built before.",
    "directory already exists": "It is created once; leave the second line out.",
    "not typed in this terminal": "Each terminal is set up by itself: source install/setup.bash there, too.",
    "ROS domain": "`python -m sim` puts the robot in domain 42, or in that of its option --domain, whatever "
    "ROS_DOMAIN_ID is: export its number in each terminal that uses ros2.",
    "Summary: 0 packages": "Is this terminal in ws? And compare the package's name with the task.",
    "colcon build is": "Leave that line out: only what the programs do is marked.",
    "needs quotes": "A value with spaces is one word only in quotes.",
    "error: ": "`ros2 --help`, and `ros2 topic --help`, show the commands and their arguments.",
    "No such file": "The file is ws/install/setup.bash. Where is this terminal? `cd` changes the folder.",
    "running in terminal": "Use another terminal, or press Ctrl-C first. Is it waiting for a wrong name?",
    "No executable found|Package .* not found": "`ros2 pkg executables` lists packages with programs.",
    "Node not found|Unable to find node": "`ros2 node list` shows which nodes are running, and their names.",
    "arameter type": "The type is that of its first value: write 1.0, not 1, for a decimal number.",
    "arameter": "`ros2 param list` shows the parameters of each node.",
    "type is invalid": "A type has three parts, such as std_msgs/msg/String: `-t` of `list` shows it.",
    "service": "`ros2 service list -t` shows the services with their types.",
    "populate field|needs a space|YAML": "`ros2 interface show` shows the fields of a type.",
    "time interval": "`sleep 5` waits 5 s.",
}
TYPED = re.compile(r"terminal \w+, line (\d+) \$ (.*)")
FAILED = re.compile(r"\[line (\d+) failed\]")  # below what a command printed


class FailedLine(NamedTuple):
    """A line that failed, by its number, and the last that it printed."""

    number: int
    printed: str


def failed_lines(run: Recording) -> list[FailedLine]:
    """The lines that failed, in order; those whose command worked in another line come last."""
    shown = [line for line in "".join(text for _, text in run.prints).splitlines() if line.strip()]
    typed = {int(found[1]): found[2].split()[:3] for found in map(TYPED.match, shown) if found}
    found = [(FAILED.fullmatch(line), before) for before, line in zip(["", *shown], shown, strict=False)]
    failed = [FailedLine(int(mark[1]), before.strip()) for mark, before in found if mark]
    numbers = {line.number for line in failed}
    well = [words for number, words in typed.items() if number not in numbers]
    return sorted(failed, key=lambda line: typed.get(line.number) in well)


@contextmanager
def first_failure(run: Recording) -> Iterator[None]:
    """Add the first line that failed to a miss in the block, and what to do about it."""
    try:
        yield
    except Missed as missed:
        for line in failed_lines(run)[:1]:
            fitting = [hint for pattern, hint in HINTS.items() if re.search(pattern, line.printed)]
            missed.saw += f"; line {line.number} failed: “{line.printed}”"
            missed.hint = (*fitting, missed.hint)[0]
        raise
