"""What the engine of one process knows of another, in which nodes of the same run live."""

from __future__ import annotations

from typing import Protocol


class Peer(Protocol):
    """Another process, in which some of the run's nodes live, as far as the engine has to do with it."""

    def close(self) -> None:
        """Leave nothing of it here."""

    def alive(self, node: str, topic: str) -> None:
        """A publisher of this process says that it is alive."""

    def seek(self, service: str | None = None) -> None:
        """A node of this process looks for services of this name, or for all that there are."""
