"""The official tools' output for the system of nodes.py.

official.txt was recorded, command by command, with ros2cli 0.32.2 and rosidl_runtime_py (branches jazzy of
github.com/ros2/ros2cli, de6cd272, and github.com/ros2/rosidl_runtime_py) on rclpy 7.1.6, rmw_fastrtps_cpp,
against `python -m tests.sim.ros2.nodes` in another process. Discovery was given 2.5 s: on a busy machine
half a second is too short. The form of `ros2 bag info` is that of format_bag_metadata.cpp in
github.com/ros2/rosbag2, branch jazzy, 64717ee8; that of `ros2 doctor` is ros2doctor's.
"""

import re
from pathlib import Path

TEXT = Path(__file__).with_name("official.txt").read_text()
# What differs from one time to another, and between machines.
VARIES = (
    (r"(?m)^GID: .*\n", ""),
    (r"(?m)^(  History \(Depth\)): .*", r"\1"),  # Fast DDS doesn't tell it of others; a recording has it
    (r"\b[0-9a-f]{32}\b", "ID"),
    (r"(sec|nanosec): \d+", r"\1: 0"),
    (r"(?m)^\d+,\d+,map", "0,0,map"),
    (r"(?m)^waiting for service to become available\.\.\.\n", ""),
    (r"(?m)^Waiting for at least 1 matching subscription\(s\)\.\.\.\n", ""),
    (r"(parameter_events|rosout)( \[.*\]) \d+ publishers", r"\1\2 publishers"),  # they count themselves, too
)


def plain(text: str) -> str:
    """The text without what varies."""
    for pattern, replacement in VARIES:
        text = re.sub(pattern, replacement, text)
    return text


def recorded() -> dict[str, str]:
    """Command to output, errors included; the first output of a command that was recorded twice."""
    found: dict[str, str] = {}
    for part in re.split(r"(?m)^\$ ros2 ", TEXT)[1:]:
        command, _, text = part.partition("\n")
        found.setdefault(command, re.sub(r"(?m)^\[exit \d+\]\n", "", text))
    return found


OFFICIAL = recorded()
