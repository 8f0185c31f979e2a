"""Parameter values and files. Upstream has them here and in `parameter_descriptions`."""

from typing import NoReturn

from launch.unsupported import refuse

from launch_ros.parameters import ParameterFile, ParameterValue

__all__ = ["ParameterFile", "ParameterValue"]


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
