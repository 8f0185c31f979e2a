"""What a launch file does with nodes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn

import yaml
from launch import Action, LaunchContext, SomeSubstitutionsType
from launch.actions import ExecuteProcess
from launch.logging import get_logger
from launch.substitutions import SubstitutionFailure
from launch.unsupported import refuse
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions, text_of

from launch_ros.parameters import ParameterFile, evaluated, evaluated_dict, kept
from launch_ros.substitutions import ExecutableInPackage

__all__ = ["Node", "PushROSNamespace", "PushRosNamespace", "SetParameter"]

NAMESPACE, PARAMETERS = "ros_namespace", "global_params"  # the configurations that all nodes look at


class Node(ExecuteProcess):
    """Starts a program with a node in it.

    executable: its name, of this package; without a package, a path or a command. name and namespace:
    those of the node, instead of its own. exec_name: what launch calls it. parameters: dictionaries, and
    paths of YAML files. remappings: pairs (from, to). ros_arguments: words after --ros-args. arguments: words
    before. All else is as for ExecuteProcess.
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
        first = executable if package is None else ExecutableInPackage(executable, package)
        words = [first, *(arguments or ()), *(["--ros-args", *ros_arguments] if ros_arguments else [])]
        super().__init__(cmd=[*words, "--ros-args"], name=exec_name, **kwargs)
        if parameters is not None:
            ensure_argument_type(parameters, list, "parameters", "Node")
        self.__package, self.__executable = package, executable
        self.__name, self.__namespace = name, namespace
        self.__parameters = list(parameters or ())
        self.__remappings = [(source, target) for source, target in remappings or ()]
        self.__final_name: str | None = None

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
        """The node's full name, as far as it was given. Raises RuntimeError before the node is executed."""
        if self.__final_name is None:
            raise RuntimeError("cannot access 'node_name' before executing action")
        return self.__final_name

    def is_node_name_fully_specified(self) -> bool:
        """Whether both name and namespace were given."""
        parts = self.UNSPECIFIED_NODE_NAME, self.UNSPECIFIED_NODE_NAMESPACE
        return not any(part in self.node_name for part in parts)

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        if self.__final_name is None:
            words = [*self.__name_words(context), *self.__parameter_words(context)]
            for source, target in self.__remappings:
                words += ["-r", f"{text_of(context, source)}:={text_of(context, target)}"]
            self.cmd.extend(normalize_to_list_of_substitutions(word) for word in words)
        super().execute(context)
        if self.is_node_name_fully_specified():
            self.__warn_of_others(context)

    def __name_words(self, context: LaunchContext) -> list[str]:
        name = None if self.__name is None else text_of(context, self.__name)
        namespace = None if self.__namespace is None else text_of(context, self.__namespace)
        try:
            namespace = _joined(context.launch_configurations.get(NAMESPACE), namespace)
            if name is not None:
                _validate_name(name)
            if namespace is not None:
                _validate_namespace(namespace)
        except Exception:
            get_logger("launch_ros.actions.node").error(
                "Error while expanding or validating node name or namespace for "
                f"'package={self.__package}, executable={self.__executable}, name={self.__name}, "
                f"namespace={self.__namespace}':"
            )
            raise
        shown = self.UNSPECIFIED_NODE_NAMESPACE if namespace is None else namespace.rstrip("/")
        self.__final_name = f"{shown}/{name or self.UNSPECIFIED_NODE_NAME}"
        words = [] if name is None else ["-r", f"__node:={name}"]
        return words if namespace is None else [*words, "-r", f"__ns:={namespace}"]

    def __parameter_words(self, context: LaunchContext) -> list[str]:
        words = []
        for name, value in context.launch_configurations.get(PARAMETERS, ()):
            words += ["-p", f"{name}:={yaml.safe_dump(value, default_flow_style=True).removesuffix(chr(10))}"]
            words[-1] = words[-1].removesuffix("\n...")
        for given in self.__parameters:
            if isinstance(given, Mapping):
                node = self.node_name if self.is_node_name_fully_specified() else "/**"
                path = kept(yaml.safe_dump({node: {"ros__parameters": evaluated_dict(context, given)}}))
            else:
                path = (given if isinstance(given, ParameterFile) else ParameterFile(given)).evaluate(context)
            if path.is_file():
                words += ["--params-file", str(path)]
            else:
                get_logger("launch_ros.actions.node").warning(f"Parameter file path is not a file: {path}")
        return words

    def __warn_of_others(self, context: LaunchContext) -> None:
        names = context.get_locals_as_dict().get("unique_ros_node_names") or {}
        context.extend_globals({"unique_ros_node_names": names})
        count = names[self.node_name] = names.get(self.node_name, 0) + 1
        if count > 1:
            get_logger(self.final_name).warning(
                f"there are now at least {count} nodes with the name {self.node_name} created within this "
                "launch context"
            )


class PushROSNamespace(Action):
    """All nodes that come after it in its group are in this namespace, below those pushed before."""

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @property
    def namespace(self) -> list[Any]:
        """The namespace."""
        return self.__namespace

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        pushed, before = text_of(context, self.__namespace), context.launch_configurations.get(NAMESPACE)
        namespace = _joined(before, pushed)
        try:
            _validate_namespace(namespace)
        except Exception:
            raise SubstitutionFailure(
                f"The resulting namespace is invalid: [previous_namespace='{before}', "
                f"pushed_namespace='{pushed}']"
            ) from None
        context.launch_configurations[NAMESPACE] = namespace


PushRosNamespace = PushROSNamespace


class SetParameter(Action):
    """All nodes that come after it in its group have this parameter."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name, self.__value = name, value

    @property
    def name(self) -> Any:
        """Its name."""
        return self.__name

    @property
    def value(self) -> Any:
        """Its value."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        name = text_of(context, self.__name)
        known = context.launch_configurations.setdefault(PARAMETERS, [])
        known.append((name, evaluated(context, name, self.__value)))


def _joined(base: str | None, namespace: str | None) -> str | None:
    """A namespace below another one, unless it begins with a slash; absolute. None for none at all."""
    if namespace is None:
        found = base
    elif namespace.startswith("/") or not base:
        found = namespace
    else:
        found = f"{base.rstrip('/')}/{namespace}"
    if found is None:
        return None
    found = found if found == "/" else found.rstrip("/")
    return found if found.startswith("/") else f"/{found}"


def _validate_name(name: str) -> None:
    from rclpy.validate_node_name import validate_node_name

    validate_node_name(name)


def _validate_namespace(namespace: str) -> None:
    from rclpy.validate_namespace import validate_namespace

    validate_namespace(namespace)


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
