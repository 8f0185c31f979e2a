"""Names and values of a node's parameters, from the node's services or from a recording."""

from __future__ import annotations

from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters

from sim.ros.messages.decoder import decode
from sim.ros2.system import System

TOPIC, TYPE = "/parameter_events", "rcl_interfaces/msg/ParameterEvent"


def names_of(system: System, node: str) -> list[str]:
    """The names of a node's parameters, sorted."""
    if system.finished:
        return sorted(_recorded(system, node))
    response = system.call(ListParameters, f"{node}/list_parameters", ListParameters.Request())
    return sorted(response.result.names)


def values_of(system: System, node: str, names: list[str]) -> list[ParameterValue]:
    """The values of some parameters; [] if the node has not declared one of them."""
    if system.finished:
        recorded = _recorded(system, node)
        return [recorded[name] for name in names] if set(names) <= set(recorded) else []
    response = system.call(GetParameters, f"{node}/get_parameters", GetParameters.Request(names=names))
    values: list[ParameterValue] = response.values
    return values


def _recorded(system: System, node: str) -> dict[str, ParameterValue]:
    """The values at the end of a run, from its parameter events."""
    values: dict[str, ParameterValue] = {}
    for message in filter(None, system.subscribe({TOPIC: TYPE})):
        event = decode(TYPE, message.raw)
        if event.node == node:
            changed = [*event.new_parameters, *event.changed_parameters]
            values |= {parameter.name: parameter.value for parameter in changed}
            for parameter in event.deleted_parameters:
                values.pop(parameter.name, None)
    return values
