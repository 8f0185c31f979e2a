"""Values and files of parameters, where upstream has them."""

from launch_ros.parameters import ParameterFile, ParameterValue

__all__ = ["ParameterFile", "ParameterValue"]
