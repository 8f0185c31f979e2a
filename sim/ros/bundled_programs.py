"""Programs of ROS packages that the course includes, because PyPI has none of them."""

from __future__ import annotations

import os
import pkgutil
import sys
from collections.abc import Callable

# Package -> program -> arguments of `python`. {domain} is replaced by ROS_DOMAIN_ID.
PROGRAMS: dict[str, dict[str, tuple[str, ...]]] = {
    "demo_nodes_py": {
        **{
            name: ("-m", f"demo_nodes_py.topics.{name}")
            for name in ("listener", "listener_qos", "listener_serialized", "talker", "talker_qos")
        },
        **{
            name: ("-m", f"demo_nodes_py.services.{name}")
            for name in ("add_two_ints_client", "add_two_ints_client_async", "add_two_ints_server")
        },
        "set_parameters_callback": ("-m", "demo_nodes_py.parameters.set_parameters_callback"),
    },
    "joint_state_publisher": {
        "joint_state_publisher": ("-m", "joint_state_publisher.joint_state_publisher"),
    },
    "robot_state_publisher": {
        "robot_state_publisher": ("-m", "robot_state_publisher.robot_state_publisher"),
    },
    "teleop_twist_keyboard": {
        "teleop_twist_keyboard": ("-m", "teleop_twist_keyboard.teleop_twist_keyboard"),
    },
    "tf2_ros": {
        "static_transform_publisher": ("-m", "tf2_ros.static_transform_publisher"),
        "tf2_echo": ("-m", "tf2_ros.tf2_echo"),
    },
    "turtlesim": {
        "turtlesim_node": ("-m", "sim", "--world", "turtlesim", "--domain", "{domain}"),
        "mimic": ("-m", "sim.ros.robots.mimic"),
    },
}
# Programs for which a run uses another module.
MODULES_IN_A_RUN: dict[tuple[str, str], str] = {
    ("turtlesim", "turtlesim_node"): "sim.ros.robots.turtlesim_node"
}
# Commands that are not part of a package -> the main() function that executes them in a run.
COMMANDS_IN_A_RUN: dict[str, str] = {"ros2": "sim.ros2.cli_program:ros2"}
# Programs that are not included: what to use instead.
ALTERNATIVES: dict[tuple[str, str], str] = {
    ("turtlesim", "turtle_teleop_key"): (
        "arrow keys drive turtle1 on the page of `ros2 run turtlesim turtlesim_node`, and in play(...)."
    ),
    ("tf2_tools", "view_frames"): "plot_frames(recording) of sim.view draws the tree of frames.",
    ("rqt_graph", "rqt_graph"): "plot_graph(recording) of sim.view draws the graph, and so does play(...).",
}


def command(package: str, name: str) -> list[str] | None:
    """The command for `ros2 run package name`, or None if the course does not include the program."""
    arguments = PROGRAMS.get(package, {}).get(name)
    if arguments is None:
        return None
    domain = os.environ.get("ROS_DOMAIN_ID", "0")
    return [sys.executable, *(argument.format(domain=domain) for argument in arguments)]


def module_in_a_run(package: str, name: str) -> str | None:
    """The module whose main() is the program in a run, or None if there is none."""
    arguments = PROGRAMS.get(package, {}).get(name, ())
    return MODULES_IN_A_RUN.get((package, name), arguments[1] if arguments else None)


def command_in_a_run(name: str) -> Callable[[], None] | None:
    """The main() function that executes a command such as `ros2` in a run, or None if there is none."""
    function = COMMANDS_IN_A_RUN.get(name)
    return None if function is None else pkgutil.resolve_name(function)


def alternative(package: str, name: str) -> str | None:
    """Return what to use instead of a program that is not included, or None."""
    return ALTERNATIVES.get((package, name))
