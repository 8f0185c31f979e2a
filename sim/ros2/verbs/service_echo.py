"""ros2 service echo: the events of a service whose introspection is enabled."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

from rclpy.qos import QoSPresetProfiles
from service_msgs.msg import ServiceEventInfo

from sim.ros.messages.decoder import decode
from sim.ros2.group import argument
from sim.ros2.interface_types import type_class
from sim.ros2.print_options import PRINTING, style_of
from sim.ros2.system import CliError, System, suggestion
from sim.ros2.text import as_csv, as_dict, dump
from sim.ros2.verbs.service import NAME, service, services

EVENTS = {
    getattr(ServiceEventInfo, name): name
    for name in ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")
}


@service.verb(
    "echo",
    NAME,
    argument(
        "service_type",
        nargs="?",
        help="Type of the ROS service (e.g. 'example_interfaces/srv/AddTwoInts')",
        completer=lambda system, options: services(system, hidden=True).get(options.service_name, []),
    ),
    *PRINTING,
)
def echo(system: System, options: Namespace) -> None:
    """Echo a service."""
    name = options.service_name if options.service_name.startswith("/") else f"/{options.service_name}"
    topic, kind = f"{name}/_service_event", f"{_type_of(system, name, options)}_Event"
    if topic not in system.names("publisher", hidden=True):
        system.print_line(
            f"No publishers on topic '{topic}'; is service introspection on the client or server enabled?"
        )
    shown = 0
    profile = QoSPresetProfiles.get_from_short_key("services_default")
    for received in system.subscribe({topic: kind}, profile):
        if received is None:
            continue
        system.print_line(_format(decode(kind, received.raw), options))
        shown += 1
        if shown == system.max_messages:
            return


def _type_of(system: System, name: str, options: Namespace) -> str:
    if options.service_type is not None:
        type_class(options.service_type, "srv", f"The service type '{options.service_type}' is invalid")
        package, *_, short = options.service_type.split("/")
        return f"{package}/srv/{short}"
    known = system.look_up(name, lambda: system.names("service", "client", hidden=True))
    if name not in known:
        raise CliError(f"Could not load the type for the passed service{suggestion(name, known)}")
    return known[name][0]


def _format(event: Any, options: Namespace) -> str:
    style = style_of(options)
    if options.csv:
        return as_csv(event, style)
    values = as_dict(event, style)
    values["info"]["event_type"] = EVENTS[event.info.event_type]
    return f"{dump(values, style)}---"
