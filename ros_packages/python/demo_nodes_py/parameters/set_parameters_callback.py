"""The program set_parameters_callback: setting param1 sets param2, too."""

from __future__ import annotations

from collections.abc import Sequence

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from demo_nodes_py.programs import spin_node

PARAM2 = 4.0  # when param1 is set


class SetParametersCallback(Node):
    """Has a callback for each step of setting a parameter."""

    def __init__(self) -> None:
        super().__init__("set_parameters_callback")
        self.internal_tracked_param_1 = self.declare_parameter("param1", 0.0).value
        self.internal_tracked_param_2 = self.declare_parameter("param2", 0.0).value
        self.add_pre_set_parameters_callback(self._extend)
        self.add_on_set_parameters_callback(self._validate)
        self.add_post_set_parameters_callback(self._store)

    def _extend(self, parameters: list[Parameter]) -> list[Parameter]:
        added = [
            Parameter("param2", Parameter.Type.DOUBLE, PARAM2)
            for parameter in parameters
            if parameter.name == "param1"
        ]
        return [*parameters, *added]

    def _validate(self, parameters: list[Parameter]) -> SetParametersResult:
        """Accept these two parameters, and no other."""
        result = SetParametersResult()
        for parameter in parameters:
            if parameter.name in ("param1", "param2"):
                result.successful, result.reason = True, f"success {parameter.name}"
        return result

    def _store(self, parameters: list[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == "param1":
                self.internal_tracked_param_1 = parameter.value
            elif parameter.name == "param2":
                self.internal_tracked_param_2 = parameter.value


def main(args: Sequence[str] | None = None) -> None:
    """Spin until Ctrl-C."""
    spin_node(SetParametersCallback, args)


if __name__ == "__main__":
    main()
