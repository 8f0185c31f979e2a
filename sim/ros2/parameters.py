"""Names and values of a node's parameters: asked of the node, or as a recording has them."""

from __future__ import annotations

from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters

from sim.ros.messages.decoder import decode
from sim.ros2.system import System, ask

EVENTS, EVENT = "/parameter_events", "rcl_interfaces/msg/ParameterEvent"


def names_of(system: System, node: str) -> list[str]:
    """The names of a node's parameters, sorted."""
    if system.over:
        return sorted(_recorded(system, node))
    request = ListParameters.Request()
    return sorted(
        system.act(lambda own, _: ask(own, ListParameters, f"{node}/list_parameters", request)).result.names
    )


def values_of(system: System, node: str, names: list[str]) -> list[ParameterValue]:
    """The values of some parameters; [] where the node has not declared one of them."""
    if system.over:
        recorded = _recorded(system, node)
        return [recorded[name] for name in names] if set(names) <= set(recorded) else []
    request = GetParameters.Request(names=names)
    return system.act(lambda own, _: ask(own, GetParameters, f"{node}/get_parameters", request)).values


def _recorded(system: System, node: str) -> dict[str, ParameterValue]:
    """What the events of a run's parameters come to: the values at its end."""
    values: dict[str, ParameterValue] = {}
    for arrived in system.listen({EVENTS: EVENT}):
        event = decode(EVENT, arrived.raw)
        if event.node == node:
            values |= {one.name: one.value for one in [*event.new_parameters, *event.changed_parameters]}
            for gone in event.deleted_parameters:
                values.pop(gone.name, None)
    return values
