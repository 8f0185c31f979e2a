"""The events of a launch file that is being executed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.event import Event
from launch.events import process
from launch.launch_description_entity import LaunchDescriptionEntity

__all__ = [
    "ExecutionComplete",
    "IncludeLaunchDescription",
    "Shutdown",
    "TimerEvent",
    "matches_action",
    "process",
]


class Shutdown(Event):
    """Everything that was launched is to shut down."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.__reason, self.__due_to_sigint = reason, due_to_sigint

    @property
    def reason(self) -> str:
        """Return why."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Return whether Ctrl-C was pressed, so that the terminal sent SIGINT to the processes, too."""
        return self.__due_to_sigint


class IncludeLaunchDescription(Event):
    """A launch description is to be executed."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: LaunchDescriptionEntity) -> None:
        self.__launch_description = launch_description

    @property
    def launch_description(self) -> LaunchDescriptionEntity:
        """The description."""
        return self.__launch_description


class TimerEvent(Event):
    """The period of a `TimerAction` has passed."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: Any) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> Any:
        """The timer."""
        return self.__timer_action


class ExecutionComplete(Event):
    """An action is complete. An action that starts a process is complete when the process has exited."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: LaunchDescriptionEntity) -> None:
        self.__action = action

    @property
    def action(self) -> LaunchDescriptionEntity:
        """The action."""
        return self.__action


def matches_action(
    target_action: LaunchDescriptionEntity,
) -> Callable[[LaunchDescriptionEntity], bool]:
    """A matcher that returns True for this action only."""
    return lambda action: action is target_action
