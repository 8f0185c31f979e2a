"""The parameters of nodes in launch files: values, texts with substitutions, and files."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import ensure_argument_type, text_of, value_of
from launch.yaml_frontend.substitutions import parse_substitution

GLOBAL_PARAMETERS = "global_params"  # the launch configuration that all nodes read
SCALARS = (bool, int, float, str)


class ParameterValue:
    """A value of this type. Without it, YAML decides on the type of a text."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.__value, self.__type = value, value_type

    @property
    def value(self) -> Any:
        """The value before its substitutions are performed."""
        return self.__value

    @property
    def value_type(self) -> Any:
        """The type."""
        return self.__type

    def evaluate(self, context: LaunchContext) -> Any:
        """The value that a node gets. Raises ValueError for text of another type."""
        if self.__type is str:
            return text_of(context, self.__value)
        if self.__type in SCALARS:
            return value_of(context, self.__value, self.__type)
        found = evaluate_parameter(context, "", self.__value)
        if self.__type is not None and not isinstance(found, list):
            raise ValueError(f"Failed to convert '{found}' to '{self.__type}'")
        return found


class ParameterFile:
    """A YAML file of parameters. allow_substs: it contains substitutions such as $(var NAME)."""

    def __init__(self, param_file: Any, *, allow_substs: bool | SomeSubstitutionsType = False) -> None:
        kinds = (str, Substitution, Sequence, os.PathLike)
        ensure_argument_type(param_file, kinds, "param_file", "ParameterFile()")
        self.__file, self.__allow_substs = param_file, allow_substs

    @property
    def param_file(self) -> Any:
        """The path."""
        return self.__file

    @property
    def allow_substs(self) -> Any:
        """Return whether it contains substitutions."""
        return self.__allow_substs

    def evaluate(self, context: LaunchContext) -> Path:
        """The path of the file that a node reads."""
        file = self.__file
        path = Path(file) if isinstance(file, os.PathLike) else Path(text_of(context, file))
        if not value_of(context, self.__allow_substs, bool):
            return path
        text = text_of(context, parse_substitution(path.read_text(encoding="utf-8")))
        try:
            yaml.safe_load(text)
        except yaml.YAMLError:
            raise SubstitutionFailure("The substituted parameter file is not a valid yaml file") from None
        return write_parameter_file(text)


def write_parameter_file(text: str) -> Path:
    """The path of a file with this text; equal texts share one. Raises PermissionError."""
    path = _private_folder() / hashlib.sha256(text.encode()).hexdigest()[:12]
    with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
        file.write(text)
    os.replace(file.name, path)
    return path


def _private_folder() -> Path:
    """A folder that only this user can read or change: all users share the one for temporary files."""
    folder = Path(tempfile.gettempdir(), f"launch_params_{os.getuid()}")
    with contextlib.suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    found = folder.lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid() or found.st_mode & 0o077:
        raise PermissionError(
            f"{folder} must be a folder that belongs to you and is closed to others: remove it, or set "
            "TMPDIR to another folder."
        )
    return folder


def evaluate_parameter_dict(
    context: LaunchContext, parameters: Mapping[Any, Any], prefix: str = ""
) -> dict[str, Any]:
    """The names and values that a node gets. Names in a nested dictionary are prefixed by its name and a dot.

    Raises TypeError for a value of a type that no parameter has.
    """
    found: dict[str, Any] = {}
    for key, value in parameters.items():
        name = prefix + text_of(context, key)
        if isinstance(value, Mapping):
            found |= evaluate_parameter_dict(context, value, f"{name}.")
        else:
            found[name] = evaluate_parameter(context, name, value)
    return found


def evaluate_parameter(context: LaunchContext, name: str, value: Any) -> Any:
    """The value that a node gets. A text with substitutions has the type that YAML gives it."""
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, SCALARS):
        return value
    if isinstance(value, Substitution):
        return _parse_yaml(name, text_of(context, value))
    if not isinstance(value, Sequence) or isinstance(value, bytes):
        raise TypeError(f"Unexpected type for parameter value {value!r}")
    if any(isinstance(part, Substitution) for part in value) and all(
        isinstance(part, str | Substitution) for part in value
    ):
        return _parse_yaml(name, text_of(context, value))  # parts of one text
    parts = [
        part if isinstance(part, SCALARS) else _parse_yaml(name, text_of(context, part)) for part in value
    ]
    if {type(part) for part in parts} == {int, float}:
        parts = [float(part) for part in parts]
    return _check_uniform(name, parts)


def _parse_yaml(name: str, text: str) -> Any:
    try:
        found = yaml.safe_load(text or "''")
    except yaml.YAMLError:
        raise TypeError(
            f"Unable to parse the value of parameter {name} as yaml. If the parameter is meant to be a "
            "string, try wrapping it in "
            "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
        ) from None
    if isinstance(found, list):
        return _check_uniform(name, found)
    if not isinstance(found, SCALARS):
        raise TypeError(
            "Allowed value types are bytes, bool, int, float, str, Sequence[bool], Sequence[int], "
            f'Sequence[float], Sequence[str]. Got {type(found)} for "{name}". '
            "If the parameter is meant to be a string, try wrapping it in "
            "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
        )
    return found


def _check_uniform(name: str, parts: list[Any]) -> list[Any]:
    if not parts or len({type(part) for part in parts}) > 1 or not isinstance(parts[0], SCALARS):
        raise TypeError(
            "Expected a non-empty sequence, with items of uniform type. Allowed sequence item types are "
            f'bool, int, float, str. Got inconsistent input for "{name}"'
        )
    return parts
