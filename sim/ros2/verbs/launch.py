"""ros2 launch: the programs of a launch file, as processes."""

from __future__ import annotations

import os
import sys
from argparse import Namespace

from sim.ros.launching import files
from sim.ros.packages import bundled_command, packages
from sim.ros2.group import Group, argument, flag
from sim.ros2.surroundings import environment_before, need_terminal
from sim.ros2.system import Voice, Wrong

launch = Group("launch", "Run a launch file")


@launch.verb(
    "",
    flag(
        "-n", "--noninteractive", help="Run the launch system non-interactively, with no terminal associated"
    ),
    flag("-d", "--debug", help="Put the launch system in debug mode, provides more verbose output."),
    flag("-p", "--print", "--print-description", help="Print the launch description without launching it."),
    flag(
        "-s", "--show-args", "--show-arguments", help="Show arguments that may be given to the launch file."
    ),
    flag("-a", "--show-all-subprocesses-output", help="Show all launched subprocesses' output"),
    argument(
        "package_name",
        help="Name of the ROS package which contains the launch file",
        offers=lambda *_: packages(),
    ),
    argument("launch_file_name", nargs="?", help="Name of the launch file"),
    argument("launch_arguments", nargs="*", help="Arguments to the launch file; '<name>:=<value>'"),
    alone=True,
)
def launch_(voice: Voice, asked: Namespace) -> None:
    """Run a launch file."""
    said = [asked.package_name, asked.launch_file_name, *asked.launch_arguments]
    words = [word for word in said if word is not None]
    try:
        path, rest = files.find_launch_file(words)
        if asked.show_args:
            return voice.say("\n".join(_shown(path)))
        if asked.print:
            return voice.say(_printed(path))
        need_terminal("launch", f'run("{" ".join(words)}")')
        description = files.load_description(path, rest)
    except files.NoLaunchFile as error:
        raise Wrong(str(error)) from None
    from launch import LaunchService  # here, for it takes a while, and other words do without
    from launch.processes import SystemProcessStarter

    if asked.show_all_subprocesses_output:
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    noninteractive = asked.noninteractive or not sys.stdin.isatty()
    service = LaunchService(argv=rest, noninteractive=noninteractive, debug=asked.debug)
    service.context.process_starter = SystemProcessStarter(bundled_command)
    service.context.replace_environment(environment_before())
    service.include_launch_description(description)
    raise SystemExit(service.run())


def _printed(path: str) -> str:
    """What is in a launch file."""
    from launch import LaunchIntrospector
    from launch.launch_description_sources import get_launch_description_from_any_launch_file

    return LaunchIntrospector().format_launch_description(get_launch_description_from_any_launch_file(path))


def _shown(path: str) -> list[str]:
    """What is said of the arguments that a launch file takes."""
    from launch.launch_description_sources import get_launch_description_from_any_launch_file

    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    found = get_launch_description_from_any_launch_file(path).get_launch_arguments()
    for each in found:
        lines += [
            "",
            f"    '{each.name}':{'*' * each._conditionally_included}",
            f"        {each.description}",
        ]
        if each.default_value is not None:
            lines.append(f"        (default: {' + '.join(part.describe() for part in each.default_value)})")
    if any(each._conditionally_included for each in found):
        lines += ["", "* argument(s) which are only used if specific conditions occur"]
    return lines if found else [*lines, "", "  No arguments."]
