"""ros2 service: list services, and call one."""

from __future__ import annotations

from argparse import Namespace

import rclpy
from rclpy.node import Node

from sim.ros2.group import Group, argument, flag
from sim.ros2.interface_types import type_class
from sim.ros2.system import POLL, CliError, Output, System, suggestion, wait_for
from sim.ros2.text import fill, read_values
from sim.ros2.verbs.publishing import positive_float
from sim.suggestions import closest_match

service = Group("service", "Services: list them, call one")
NAME = argument(
    "service_name",
    help="Name of the ROS service (e.g. '/add_two_ints')",
    completer=lambda system, _: list(services(system)),
)
HIDDEN = flag("--include-hidden-services", help="Consider hidden services as well")
COUNT = flag("-c", "--count-services", help="Only display the number of services discovered")


def services(system: System, *, hidden: bool = False) -> dict[str, list[str]]:
    """Name to types of all services that have a server."""
    return system.names("service", hidden=hidden)


@service.verb("list", flag("-t", "--show-types", help="Additionally show the service type"), COUNT, HIDDEN)
def list_(system: System, options: Namespace) -> None:
    """Output a list of available services."""
    found = services(system, hidden=options.include_hidden_services)
    if options.count_services:
        system.print_line(str(len(found)))
        return
    for name, types in found.items():
        system.print_line(f"{name} [{', '.join(types)}]" if options.show_types else name)


@service.verb("type", NAME)
def type_(system: System, options: Namespace) -> None:
    """Output a service's type."""
    found = services(system, hidden=True)
    if options.service_name not in found:
        raise CliError(f"Unknown service '{options.service_name}'{suggestion(options.service_name, found)}")
    for name in found[options.service_name]:
        system.print_line(name)


@service.verb("info", NAME)
def info(system: System, options: Namespace) -> None:
    """Print information about a service."""
    name, found = options.service_name, services(system, hidden=True)
    if name not in found:
        raise CliError(f"Unknown service '{name}'{suggestion(name, found)}")
    system.print_line(f"Type: {found[name][0] if len(found[name]) == 1 else found[name]}")
    for title, kind in (("Clients", "client"), ("Services", "service")):
        count = sum((end.kind, end.name) == (kind, name) for end in system.endpoints)
        system.print_line(f"{title} count: {count}")


@service.verb("find", argument("service_type", help="Service type to filter for"), COUNT, HIDDEN)
def find(system: System, options: Namespace) -> None:
    """Output a list of available services of a given type."""
    known = services(system, hidden=options.include_hidden_services)
    found = [name for name, types in known.items() if options.service_type in types]
    for line in [str(len(found))] if options.count_services else found:
        system.print_line(line)


@service.verb(
    "call",
    NAME,
    argument(
        "service_type",
        help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')",
        completer=lambda system, options: services(system, hidden=True).get(options.service_name, []),
    ),
    argument("values", nargs="?", default="{}", help="Values in YAML (e.g. '{a: 1, b: 2}')"),
    argument("-r", "--rate", type=positive_float, metavar="N", help="Repeat the call at this rate in Hz"),
)
def call(system: System, options: Namespace) -> None:
    """Call a service."""
    kind = type_class(options.service_type, "srv", "The passed service type is invalid")
    request = kind.Request()
    fill(request, read_values(options.values))
    system.run_with_node(
        lambda node, output: _call(node, output, kind, request, options),
        system.time_limit if options.rate else None,
    )


def _call(node: Node, output: Output, kind: type, request: object, options: Namespace) -> None:
    client = node.create_client(kind, options.service_name)
    if not client.service_is_ready():
        output.print_line("waiting for service to become available..." + _near(node, client.srv_name))
        while not client.service_is_ready() and not output.canceled:
            rclpy.spin_once(node, timeout_sec=POLL)
    while True:
        output.print_line(f"requester: making request: {request!r}\n")
        output.print_line(f"response:\n{wait_for(node, client.call_async(request))!r}\n")
        if options.rate is None or output.canceled:
            return
        node.get_clock().sleep_for(rclpy.duration.Duration(seconds=1 / options.rate))


def _near(node: Node, name: str) -> str:
    known = [other for other, _ in node.get_service_names_and_types() if other != name]
    near = closest_match(name, known)
    return f" Did you mean {near}?" if near else ""
