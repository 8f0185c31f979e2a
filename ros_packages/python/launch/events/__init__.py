"""What may happen while a launch file is carried out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch.entities import Action, Event, LaunchDescriptionEntity


class Shutdown(Event):
    """All that was launched is to end."""

    name = "launch.events.Shutdown"

    def __init__(self, *, reason: str = "reason not given", due_to_sigint: bool = False) -> None:
        self.__reason, self.__due_to_sigint = reason, due_to_sigint

    @property
    def reason(self) -> str:
        """Why."""
        return self.__reason

    @property
    def due_to_sigint(self) -> bool:
        """Whether the terminal has told the programs, too."""
        return self.__due_to_sigint


class IncludeLaunchDescription(Event):
    """A launch description is to be carried out."""

    name = "launch.events.IncludeLaunchDescription"

    def __init__(self, launch_description: LaunchDescriptionEntity) -> None:
        self.__launch_description = launch_description

    @property
    def launch_description(self) -> LaunchDescriptionEntity:
        """The description."""
        return self.__launch_description


class TimerEvent(Event):
    """The time of a timer is over."""

    name = "launch.events.TimerEvent"

    def __init__(self, *, timer_action: Any) -> None:
        self.__timer_action = timer_action

    @property
    def timer_action(self) -> Any:
        """The timer."""
        return self.__timer_action


class ExecutionComplete(Event):
    """An action has done all that it does; of a program, it has ended."""

    name = "launch.events.ExecutionComplete"

    def __init__(self, *, action: Action) -> None:
        self.__action = action

    @property
    def action(self) -> Action:
        """The action."""
        return self.__action


def matches_action(target_action: Action) -> Callable[[Action], bool]:
    """A matcher that is true of this action alone."""
    return lambda action: action is target_action


from launch.events import process  # noqa: E402  (which needs what is above)

__all__ = [
    "ExecutionComplete",
    "IncludeLaunchDescription",
    "Shutdown",
    "TimerEvent",
    "matches_action",
    "process",
]
