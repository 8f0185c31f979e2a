"""What a launch file can do."""

from typing import NoReturn

from launch.actions.execute_process import ExecuteProcess
from launch.actions.flow import GroupAction, IncludeLaunchDescription, OpaqueFunction
from launch.actions.happenings import EmitEvent, RegisterEventHandler, Shutdown, TimerAction
from launch.actions.settings import (
    DeclareLaunchArgument,
    LogInfo,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
)
from launch.unsupported import refuse

__all__ = [
    "DeclareLaunchArgument",
    "EmitEvent",
    "ExecuteProcess",
    "GroupAction",
    "IncludeLaunchDescription",
    "LogInfo",
    "OpaqueFunction",
    "RegisterEventHandler",
    "SetEnvironmentVariable",
    "SetLaunchConfiguration",
    "Shutdown",
    "TimerAction",
]


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
