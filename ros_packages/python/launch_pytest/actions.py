"""The action `ReadyToTest`."""

from __future__ import annotations

import asyncio
from typing import Any

from launch import Action, LaunchContext
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnShutdown

__all__ = ["ReadyToTest"]

ON_READY = "launch_pytest_on_ready"  # the global of the launch context that ReadyToTest calls


class ReadyToTest(Action):
    """Lets the tests begin. The launch service is then not idle until it is shut down.

    Outside launch_pytest, for example in `ros2 launch`, it does nothing.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__over: asyncio.Future | None = None

    def get_asyncio_future(self) -> asyncio.Future | None:
        """Work like `LaunchDescriptionEntity`."""
        return self.__over

    def execute(self, context: LaunchContext) -> list[Action]:
        """Work like `Action`."""
        on_ready = context.get_locals_as_dict().get(ON_READY)
        if on_ready is None or context.is_shutdown:
            return []
        self.__over = context.asyncio_loop.create_future()
        on_ready()
        return [RegisterEventHandler(OnShutdown(on_shutdown=self.__end))]

    def __end(self, *_: Any) -> None:
        if not self.__over.done():
            self.__over.set_result(None)
