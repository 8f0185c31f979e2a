"""What a node declares as its parameters, and what others ask of them."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService

from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook
from sim.ros.messages.lenient import convert_parameters, resolve_parameter_name


@hook(Node, "declare_parameters", "the recording knows which names that others give or ask for are nobody's")
def declare_parameters(original: Callable) -> Callable:
    def declare_parameters(
        self: Node, namespace: str, parameters: Sequence[Any], *more: Any, **keywords: Any
    ) -> list[Parameter]:
        run = engine()
        if run is None:
            return original(self, namespace, parameters, *more, **keywords)
        made = original(self, namespace, convert_parameters(parameters), *more, **keywords)
        run.recorder.parameters(self, [parameter.name for parameter in made], declared=True)
        return made

    return declare_parameters


@hook(ParameterService, "_get_parameters_callback", "a program that is forgiven a slip has what is asked for")
def get_parameters(original: Callable) -> Callable:
    @functools.wraps(original)  # a callback is told of by its name
    def _get_parameters_callback(self: ParameterService, request: Any, response: Any) -> Any:
        if engine() is not None:
            request.names = [
                resolve_parameter_name(name, self._get_node()._parameters) for name in request.names
            ]
        return original(self, request, response)

    return _get_parameters_callback


@hook(ParameterService, "_set_parameters_callback", "a program that is forgiven a slip has what is set")
def set_parameters(original: Callable) -> Callable:
    @functools.wraps(original)
    def _set_parameters_callback(self: ParameterService, request: Any, response: Any) -> Any:
        if engine() is not None:
            for parameter in request.parameters:
                parameter.name = resolve_parameter_name(parameter.name, self._get_node()._parameters)
        return original(self, request, response)

    return _set_parameters_callback
