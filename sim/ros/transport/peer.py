"""What the engine of one process knows of another process, in which nodes of the same run live."""

from __future__ import annotations

from typing import Protocol


class Peer(Protocol):
    """Another process, in which some of the run's nodes live, as far as the engine is concerned with it."""

    blocked: str  # which callback there waits for something that can't come, in a sentence; or ""

    def close(self) -> None:
        """Destroy what represents it in this process."""

    def alive(self, node: str, topic: str) -> None:
        """A publisher of this process asserts its liveliness."""

    def seek(self, service: str | None = None) -> None:
        """A node of this process looks for services of this name, or for all that there are."""

    def handle_destroyed(self) -> None:
        """A handle of rclpy was destroyed in this process."""
