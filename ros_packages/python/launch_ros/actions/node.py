"""The action `Node`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from launch.action import Action
from launch.actions import ExecuteProcess
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions, text_of

from launch_ros.actions.set_remap import REMAPPINGS
from launch_ros.namespaces import NAMESPACE, join_namespaces, validate_name, validate_namespace
from launch_ros.parameters import (
    GLOBAL_PARAMETERS,
    ParameterFile,
    evaluate_parameter_dict,
    write_parameter_file,
)
from launch_ros.substitutions import ExecutableInPackage


class Node(ExecuteProcess):
    """Starts a node.

    executable: its name in the package; without a package, a path or a command. name and namespace: replace
    the node's own. exec_name: the name in the log. parameters: dictionaries and paths of YAML files.
    remappings: pairs (from, to). arguments: command-line arguments before --ros-args; ros_arguments: after
    it. The other arguments are those of ExecuteProcess.
    """

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(
        self,
        *,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        exec_name: SomeSubstitutionsType | None = None,
        parameters: Sequence[Any] | None = None,
        remappings: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]] | None = None,
        ros_arguments: Iterable[SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        path = executable if package is None else ExecutableInPackage(executable, package)
        cmd = [path, *(arguments or ()), *(["--ros-args", *ros_arguments] if ros_arguments else [])]
        super().__init__(cmd=[*cmd, "--ros-args"], name=exec_name, **kwargs)
        if parameters is not None:
            ensure_argument_type(parameters, list, "parameters", "Node")
        self.__package, self.__executable = package, executable
        self.__name, self.__namespace = name, namespace
        self.__parameters = list(parameters or ())
        self.__remappings = [(source, target) for source, target in remappings or ()]
        self.__final_name: str | None = None
        self.__name_rules: list[str] = []

    @property
    def node_package(self) -> Any:
        """The package."""
        return self.__package

    @property
    def node_executable(self) -> Any:
        """The name of the executable."""
        return self.__executable

    @property
    def node_name(self) -> str:
        """The full name, as far as it is specified. Raises RuntimeError before the action is executed."""
        if self.__final_name is None:
            raise RuntimeError("cannot access 'node_name' before executing action")
        return self.__final_name

    @property
    def is_lifecycle_node(self) -> bool:
        """Return whether the node has the states of a lifecycle."""
        return False

    def is_node_name_fully_specified(self) -> bool:
        """Return whether both name and namespace are specified."""
        parts = self.UNSPECIFIED_NODE_NAME, self.UNSPECIFIED_NODE_NAMESPACE
        return not any(part in self.node_name for part in parts)

    def execute(self, context: LaunchContext) -> list[Action] | None:
        """Work like `Action`."""
        first_time = self.final_cmd is None
        self._expand_name(context)
        if first_time:
            arguments = [*self.__name_rules, *self.__parameter_arguments(context)]
            for source, target in [*context.launch_configurations.get(REMAPPINGS, ()), *self.__remappings]:
                arguments += ["-r", f"{text_of(context, source)}:={text_of(context, target)}"]
            self.cmd.extend(normalize_to_list_of_substitutions(argument) for argument in arguments)
        super().execute(context)
        if self.is_node_name_fully_specified():
            self.__warn_if_not_unique(context)
        return None

    def _expand_name(self, context: LaunchContext) -> None:
        """Perform the substitutions in name and namespace, once; raises what makes them invalid."""
        if self.__final_name is not None:
            return
        name = None if self.__name is None else text_of(context, self.__name)
        namespace = None if self.__namespace is None else text_of(context, self.__namespace)
        try:
            namespace = join_namespaces(context.launch_configurations.get(NAMESPACE), namespace)
            if name is not None:
                validate_name(name)
            if namespace is not None:
                validate_namespace(namespace)
        except Exception:
            get_logger("launch_ros.actions.node").error(
                "Error while expanding or validating node name or namespace for "
                f"'package={self.__package}, executable={self.__executable}, name={self.__name}, "
                f"namespace={self.__namespace}':"
            )
            raise
        shown = self.UNSPECIFIED_NODE_NAMESPACE if namespace is None else namespace.rstrip("/")
        self.__final_name = f"{shown}/{name or self.UNSPECIFIED_NODE_NAME}"
        rules = {"__node": name, "__ns": namespace}
        self.__name_rules = [
            word for key, value in rules.items() if value is not None for word in ("-r", f"{key}:={value}")
        ]

    def __parameter_arguments(self, context: LaunchContext) -> list[str]:
        arguments = _arguments_for_all_nodes(context)
        for given in self.__parameters:
            if isinstance(given, Mapping):
                node = self.node_name if self.is_node_name_fully_specified() else "/**"
                values = evaluate_parameter_dict(context, given)
                path = write_parameter_file(yaml.safe_dump({node: {"ros__parameters": values}}))
            else:
                path = (given if isinstance(given, ParameterFile) else ParameterFile(given)).evaluate(context)
            arguments += _file_arguments(path)
        return arguments

    def __warn_if_not_unique(self, context: LaunchContext) -> None:
        names = context.get_locals_as_dict().get("unique_ros_node_names") or {}
        context.extend_globals({"unique_ros_node_names": names})
        count = names[self.node_name] = names.get(self.node_name, 0) + 1
        if count > 1:
            get_logger(self.final_name).warning(
                f"there are now at least {count} nodes with the name {self.node_name} created within this "
                "launch context"
            )


def _arguments_for_all_nodes(context: LaunchContext) -> list[str]:
    """The arguments for what SetParameter has set."""
    arguments = []
    for name, value in context.launch_configurations.get(GLOBAL_PARAMETERS, ()):
        text = yaml.safe_dump(value, default_flow_style=True).removesuffix("\n").removesuffix("\n...")
        arguments += ["-p", f"{name}:={text}"]
    return arguments


def _file_arguments(path: Path) -> list[str]:
    """The arguments for a file of parameters; none and a warning if it isn't a file."""
    if path.is_file():
        return ["--params-file", str(path)]
    get_logger("launch_ros.actions.node").warning(f"Parameter file path is not a file: {path}")
    return []
