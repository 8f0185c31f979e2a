"""The connection to a Dask scheduler. This module imports Dask, so it is only loaded when it is used."""

import logging

import dask
from distributed import Client


class Connection(Client):
    """A client that is closed at once if it can't be opened.

    Dask leaves that to garbage collection. That may run in the thread that the next client waits for, and
    closing needs a lock which that client holds: both would wait for 10 s, and the next client would fail.
    """

    def start(self, **kwargs: object) -> None:
        """Connect, as its constructor does."""
        try:
            super().start(**kwargs)  # type: ignore[no-untyped-call]
        except BaseException:
            self.close()
            raise


def connect(address: str, wait_s: float) -> Connection:
    """Connect to the scheduler at `address`. Raises OSError, ValueError, TypeError, RuntimeError."""
    for name in ("distributed", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # errors are reported by DaskPoolError
    dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 GB"})  # a notebook may have 128 MB
    return Connection(address, timeout=wait_s, set_as_default=False)
