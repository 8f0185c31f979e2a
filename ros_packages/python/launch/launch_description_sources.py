"""The sources of launch descriptions: launch files in Python, YAML and XML."""

from __future__ import annotations

import difflib
import importlib
import traceback
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from typing import NoReturn

from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.located import PYTHON_FILE
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType
from launch.unsupported import refuse
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

__all__ = [
    "AnyLaunchDescriptionSource",
    "InvalidLaunchFileError",
    "InvalidPythonLaunchFileError",
    "PythonLaunchDescriptionSource",
]

# A plug-in, imported by name on first use: it makes actions, which may include launch descriptions.
YAML_FRONTEND = "launch.yaml_frontend.launch_file"


class InvalidPythonLaunchFileError(Exception):
    """A Python file lacks the function `generate_launch_description`."""


class InvalidLaunchFileError(Exception):
    """A file is not a launch file."""


def get_launch_description_from_python_launch_file(python_launch_file_path: str) -> LaunchDescription:
    """The result of `generate_launch_description()` in a file. Raises InvalidPythonLaunchFileError."""
    _check_is_there(python_launch_file_path)
    loader = SourceFileLoader(PYTHON_FILE, str(python_launch_file_path))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    exec(loader.source_to_code(Path(loader.path).read_bytes(), loader.path), vars(module))  # never cached
    if not hasattr(module, "generate_launch_description"):
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' does not contain the required function "
            "'generate_launch_description()'"
        )
    return module.generate_launch_description()


def get_launch_description_from_yaml_launch_file(path: str) -> LaunchDescription:
    """The launch description in a YAML file."""
    return importlib.import_module(YAML_FRONTEND).read(path)


def get_launch_description_from_xml_launch_file(path: str) -> LaunchDescription:
    """The launch description in an XML file."""
    return importlib.import_module(YAML_FRONTEND).read_xml(path)


def get_launch_description_from_any_launch_file(launch_file_path: str) -> LaunchDescription:
    """The launch description in a file, by its suffix. Raises InvalidLaunchFileError for an unknown one."""
    _check_is_there(launch_file_path)
    kind = Path(launch_file_path).suffix
    if kind == ".py":
        return get_launch_description_from_python_launch_file(launch_file_path)
    if kind in (".yaml", ".yml"):
        return get_launch_description_from_yaml_launch_file(launch_file_path)
    if kind in (".xml", ".launch"):
        return get_launch_description_from_xml_launch_file(launch_file_path)
    raise InvalidLaunchFileError(
        f"'{launch_file_path}' is not a launch file that can be read here: they are in Python (.py), XML "
        "(.xml, .launch) or YAML (.yaml)."
    )


def _check_is_there(path: str) -> None:
    """Raise FileNotFoundError with the file of nearly that name, if there is no such file."""
    if Path(path).is_file():
        return
    folder = Path(path).parent
    names = [file.name for file in folder.iterdir() if file.is_file()] if folder.is_dir() else []
    near = next(iter(difflib.get_close_matches(Path(path).name, sorted(names), n=1, cutoff=0.8)), "")
    guess = f". Did you mean '{near}'?" if near else ""
    raise FileNotFoundError(f"[Errno 2] No such file or directory: '{path}'{guess}")


class LaunchDescriptionSource:
    """A launch description, or the place where it is."""

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.__launch_description = launch_description
        self.__location = normalize_to_list_of_substitutions(location)
        self.__expanded_location: str | None = None
        self.__method = method

    @property
    def location(self) -> str:
        """The path of the launch file."""
        if self.__expanded_location is None:
            return " + ".join(map(str, self.__location))
        return self.__expanded_location

    @property
    def method(self) -> str:
        """Return how it is read, for people."""
        return self.__method

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """The description, if its location is known before anything is launched."""
        if self.__launch_description is None:
            try:
                return self._get_launch_description(perform_substitutions(LaunchContext(), self.__location))
            except Exception as error:
                get_logger("launch").debug(traceback.format_exc())
                get_logger("launch").debug(f"Failed to load the launch file without a context: {error}")
        return self.__launch_description

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """The description. Raises the errors of reading it."""
        if self.__expanded_location is None:
            self.__expanded_location = perform_substitutions(context, self.__location)
        if self.__launch_description is None:
            self.__launch_description = self._get_launch_description(self.__expanded_location)
        return self.__launch_description

    def _get_launch_description(self, location: str) -> LaunchDescription:
        raise RuntimeError(
            "LaunchDescriptionSource.get_launch_description(): called without launch description being set"
        )


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_python_launch_file(location)


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python, YAML or XML, by its suffix."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(location)


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
