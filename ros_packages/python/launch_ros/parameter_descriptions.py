"""Parameter values and files."""

from launch_ros.parameters import ParameterFile, ParameterValue

__all__ = ["ParameterFile", "ParameterValue"]
