"""ros2 launch: executes a launch file with processes of the system."""

from __future__ import annotations

import os
import sys
from argparse import Namespace

from sim import ros_environment
from sim.ros.absent_names import explain_absent_name
from sim.ros.launching import files
from sim.ros.left_out import command_of_launch
from sim.ros.packages import packages
from sim.ros2.domains import selected_domain
from sim.ros2.environment import environment_before, require_terminal
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import CliError, Output

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
        completer=lambda *_: packages(),
    ),
    argument("launch_file_name", nargs="?", help="Name of the launch file"),
    argument("launch_arguments", nargs="*", help="Arguments to the launch file; '<name>:=<value>'"),
    without_system=True,
)
def launch_(output: Output, options: Namespace) -> None:
    """Run a launch file."""
    given = options.package_name, options.launch_file_name, *options.launch_arguments
    arguments = [each for each in given if each is not None]
    try:
        path, rest = files.find_launch_file(arguments)
        if options.show_args:
            return output.print_line("\n".join(_argument_lines(path)))
        if options.print:
            return output.print_line(_description(path))
        require_terminal("launch", f'run("{" ".join(arguments)}")')
        description = files.load_description(path, rest)
    except files.NoLaunchFile as error:
        raise CliError(str(error)) from None
    from launch import LaunchService  # imported late, because it is slow and other commands don't need it
    from launch.processes import SystemProcessStarter

    if options.show_all_subprocesses_output:
        os.environ["OVERRIDE_LAUNCH_PROCESS_OUTPUT"] = "both"
    ros_environment.open_to_this_machine(selected_domain())  # for launch's own node, with lifecycle nodes
    noninteractive = options.noninteractive or not sys.stdin.isatty()
    service = LaunchService(argv=rest, noninteractive=noninteractive, debug=options.debug)
    service.context.process_starter = SystemProcessStarter(command_of_launch)
    service.context.replace_environment(environment_before())
    service.include_launch_description(description)
    status = service.run()
    hint = explain_absent_name(type(service.failure).__name__, str(service.failure))
    if hint:
        print(hint, file=sys.stderr)
    raise SystemExit(status)


def _description(path: str) -> str:
    """The content of a launch file, for --print."""
    from launch import LaunchIntrospector
    from launch.launch_description_sources import get_launch_description_from_any_launch_file

    description = get_launch_description_from_any_launch_file(path)
    text: str = LaunchIntrospector().format_launch_description(description)
    return text


def _argument_lines(path: str) -> list[str]:
    """The description of a launch file's arguments, for --show-args."""
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
