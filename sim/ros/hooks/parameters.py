"""The parameters that nodes declare, and that others get and set."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.exceptions import ParameterException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService

from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook
from sim.ros.messages.lenient import convert_override, convert_parameters, resolve_parameter_name


@hook(Node, "declare_parameters", "the recording has the names, so that a misspelt one is found")
def declare_parameters(original: Callable) -> Callable:
    def declare_parameters(
        self: Node, namespace: str, parameters: Sequence[Any], *more: Any, **keywords: Any
    ) -> list[Parameter]:
        run = engine()
        if run is None:
            return original(self, namespace, parameters, *more, **keywords)
        _convert_overrides(self, namespace, parameters)
        try:
            made = original(self, namespace, convert_parameters(parameters), *more, **keywords)
        except ParameterException:  # such as a start value that the node's own check refuses
            names = [f"{namespace}.{row[0]}" if namespace else row[0] for row in parameters]
            run.recorder.parameters(self, names, declared=True)
            raise
        run.recorder.parameters(self, [parameter.name for parameter in made], declared=True)
        return made

    return declare_parameters


def _convert_overrides(node: Node, namespace: str, parameters: Sequence[Any]) -> None:
    for row in parameters:
        name = f"{namespace}.{row[0]}" if namespace else row[0]
        given = node._parameter_overrides.get(name)
        if given is not None and len(row) > 1:
            value = convert_override(given.value, row[1])
            if value is not given.value:
                node._parameter_overrides[name] = Parameter(name, value=value)


@hook(ParameterService, "_get_parameters_callback", "lenient programs find a parameter despite a typo")
def get_parameters(original: Callable) -> Callable:
    @functools.wraps(original)  # the callback is recorded by its name
    def _get_parameters_callback(self: ParameterService, request: Any, response: Any) -> Any:
        if engine() is not None:
            request.names = [
                resolve_parameter_name(name, self._get_node()._parameters) for name in request.names
            ]
        return original(self, request, response)

    return _get_parameters_callback


@hook(ParameterService, "_set_parameters_callback", "lenient programs set a parameter despite a typo")
def set_parameters(original: Callable) -> Callable:
    @functools.wraps(original)
    def _set_parameters_callback(self: ParameterService, request: Any, response: Any) -> Any:
        if engine() is not None:
            for parameter in request.parameters:
                parameter.name = resolve_parameter_name(parameter.name, self._get_node()._parameters)
        return original(self, request, response)

    return _set_parameters_callback
