"""ros2 service: which services there are, and a call of one."""

from __future__ import annotations

from argparse import Namespace

import rclpy
from rclpy.node import Node

from sim.ros2.group import Group, argument, flag
from sim.ros2.system import POLL, System, Voice, Wrong, answer, guess
from sim.ros2.text import fill, read_values
from sim.ros2.types import type_of
from sim.ros2.verbs.publishing import positive_number
from sim.suggestions import closest_match

service = Group("service", "Services: list them, call one")
NAME = argument(
    "service_name",
    help="Name of the ROS service (e.g. '/add_two_ints')",
    offers=lambda system, _: list(services(system)),
)
HIDDEN = flag("--include-hidden-services", help="Consider hidden services as well")
COUNT = flag("-c", "--count-services", help="Only display the number of services discovered")


def services(system: System, *, hidden: bool = False) -> dict[str, list[str]]:
    """Name to types of all services that a node offers."""
    return system.names("service", hidden=hidden)


@service.verb("list", flag("-t", "--show-types", help="Additionally show the service type"), COUNT, HIDDEN)
def list_(system: System, asked: Namespace) -> None:
    """Output a list of available services."""
    found = services(system, hidden=asked.include_hidden_services)
    if asked.count_services:
        system.say(str(len(found)))
        return
    for name, types in found.items():
        system.say(f"{name} [{', '.join(types)}]" if asked.show_types else name)


@service.verb("type", NAME)
def type_(system: System, asked: Namespace) -> None:
    """Output a service's type."""
    found = services(system, hidden=True)
    if asked.service_name not in found:
        raise Wrong(f"Unknown service '{asked.service_name}'{guess(asked.service_name, found)}")
    for name in found[asked.service_name]:
        system.say(name)


@service.verb("info", NAME)
def info(system: System, asked: Namespace) -> None:
    """Print information about a service."""
    name, found = asked.service_name, services(system, hidden=True)
    if name not in found:
        raise Wrong(f"Unknown service '{name}'{guess(name, found)}")
    system.say(f"Type: {found[name][0] if len(found[name]) == 1 else found[name]}")
    for words, kind in (("Clients", "client"), ("Services", "service")):
        count = sum((end.kind, end.name) == (kind, name) for end in system.ends)
        system.say(f"{words} count: {count}")


@service.verb("find", argument("service_type", help="Service type to filter for"), COUNT, HIDDEN)
def find(system: System, asked: Namespace) -> None:
    """Output a list of available services of a given type."""
    known = services(system, hidden=asked.include_hidden_services)
    found = [name for name, types in known.items() if asked.service_type in types]
    for line in [str(len(found))] if asked.count_services else found:
        system.say(line)


@service.verb(
    "call",
    NAME,
    argument(
        "service_type",
        help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')",
        offers=lambda system, asked: services(system, hidden=True).get(asked.service_name, []),
    ),
    argument("values", nargs="?", default="{}", help="Values in YAML (e.g. '{a: 1, b: 2}')"),
    argument("-r", "--rate", type=positive_number, metavar="N", help="Repeat the call at this rate in Hz"),
)
def call(system: System, asked: Namespace) -> None:
    """Call a service."""
    kind = type_of(asked.service_type, "srv", "The passed service type is invalid")
    request = kind.Request()
    fill(request, read_values(asked.values))
    system.act(
        lambda node, voice: _call(node, voice, kind, request, asked), system.window if asked.rate else None
    )


def _call(node: Node, voice: Voice, kind: type, request: object, asked: Namespace) -> None:
    client = node.create_client(kind, asked.service_name)
    if not client.service_is_ready():
        voice.say("waiting for service to become available..." + _near(node, client.srv_name))
        while not client.service_is_ready() and not voice.stopped:
            rclpy.spin_once(node, timeout_sec=POLL)
    while True:
        voice.say(f"requester: making request: {request!r}\n")
        voice.say(f"response:\n{answer(node, client.call_async(request))!r}\n")
        if asked.rate is None or voice.stopped:
            return
        node.get_clock().sleep_for(rclpy.duration.Duration(seconds=1 / asked.rate))


def _near(node: Node, name: str) -> str:
    known = [other for other, _ in node.get_service_names_and_types() if other != name]
    near = closest_match(name, known)
    return f" Did you mean {near}?" if near else ""
