"""A launch description that is executed beside tests."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterable, Sequence
from typing import Any

from launch import LaunchDescription, LaunchDescriptionEntity, LaunchService

from launch_pytest.actions import ON_READY, ReadyToTest


class LaunchFailed(Exception):
    """The launch description could not be executed as a test needs it."""


class LaunchRun:
    """Executes a launch description in a thread. service: its launch service.

    value: what the fixture returned. Raises LaunchFailed where that is no launch description.
    """

    def __init__(self, value: Any) -> None:
        first = value[0] if isinstance(value, Sequence) and value else value
        if not isinstance(first, LaunchDescription):
            raise LaunchFailed(
                "a launch_pytest fixture returns a LaunchDescription, or a sequence that begins with one: "
                f"this one returned {value!r}."
            )
        self.service = LaunchService(noninteractive=True)
        self.service.context.extend_globals({ON_READY: self._on_ready})
        parts = [first] if _has_ready_action([first]) else [first, ReadyToTest()]
        self.service.include_launch_description(LaunchDescription(parts))
        self._changed, self._ready = threading.Event(), False
        self._thread = threading.Thread(target=self._execute, name="launch", daemon=True)

    @property
    def is_over(self) -> bool:
        """Return whether everything that was launched has exited."""
        return not self._thread.is_alive()

    def start(self) -> None:
        """Execute the description until ReadyToTest. Raises LaunchFailed if it ends before."""
        self._thread.start()
        self._changed.wait()
        if self._ready:
            return
        self._thread.join()
        self.raise_failure()
        raise LaunchFailed("the launch ended before ReadyToTest was executed, so no test could run.")

    def shut_down(self) -> None:
        """End everything that was launched, and wait until it has exited."""
        self.service.shutdown()
        self._thread.join()

    def raise_failure(self) -> None:
        """Raise LaunchFailed if an error has ended the launch."""
        failure = getattr(self.service, "failure", None)
        if failure is not None:
            raise LaunchFailed(f"the launch failed: {failure}") from failure

    def _on_ready(self) -> None:
        self._ready = True
        self._changed.set()

    def _execute(self) -> None:
        try:
            asyncio.run(self.service.run_async())
        finally:
            self._changed.set()


def _has_ready_action(entities: Iterable[LaunchDescriptionEntity]) -> bool:
    for entity in entities:
        inner = list(entity.describe_sub_entities())
        for _, conditional in entity.describe_conditional_sub_entities():
            inner += conditional
        if isinstance(entity, ReadyToTest) or _has_ready_action(inner):
            return True
    return False
