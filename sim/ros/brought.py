"""Programs of ROS's own packages that the course brings along, as tutorials start them."""

from __future__ import annotations

import os
import sys

# The words after `python` by package and program. {domain} is the one of the terminal.
PROGRAMS: dict[str, dict[str, tuple[str, ...]]] = {
    "tf2_ros": {
        "static_transform_publisher": ("-m", "tf2_ros.static_transform_publisher"),
        "tf2_echo": ("-m", "tf2_ros.tf2_echo"),
    },
    "turtlesim": {
        "turtlesim_node": ("-m", "sim", "--world", "turtlesim", "--domain", "{domain}"),
        "mimic": ("-m", "sim.ros.robots.mimic"),
    },
}
# Where another module is the program in a run.
IN_A_RUN: dict[tuple[str, str], str] = {("turtlesim", "turtlesim_node"): "sim.ros.robots.turtlesim_node"}
# Of what there is none here: what does its work.
INSTEAD: dict[tuple[str, str], str] = {
    ("turtlesim", "turtle_teleop_key"): (
        "arrow keys drive turtle1 on the page of `ros2 run turtlesim turtlesim_node`, and in play(...)."
    ),
    ("tf2_tools", "view_frames"): "plot_frames(recording) of sim.view draws the tree of frames.",
    ("rqt_graph", "rqt_graph"): "plot_graph(recording) of sim.view draws the graph, and so does play(...).",
}


def command(package: str, name: str) -> list[str] | None:
    """What to start for `ros2 run package name`; None where the course brings no such program."""
    words = PROGRAMS.get(package, {}).get(name)
    if words is None:
        return None
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    return [sys.executable, *(word.format(domain=domain) for word in words)]


def module(package: str, name: str) -> str | None:
    """The module whose main() is the program, for a run; None where there is none."""
    words = PROGRAMS.get(package, {}).get(name, ())
    return IN_A_RUN.get((package, name), words[1] if words else None)


def instead(package: str, name: str) -> str | None:
    """What does the work of a program that there is none of here."""
    return INSTEAD.get((package, name))
