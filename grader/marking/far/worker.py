"""What a Dask worker does: marks one submission after the other, in a pool of its own.

Nothing in here raises: Dask would write the order, and the secret in it, into the worker's log.
"""

from __future__ import annotations

import atexit
import tempfile
import threading
from pathlib import Path
from typing import Any

from grader.marking.far.parcel import unpack
from grader.marking.orders import Patience
from grader.marking.plan import Task
from grader.marking.pool import Pool
from grader.marking.sandbox import Limits, SandboxFailed, SandboxMissing
from grader.marking.version import versions

# As this process has loaded them: a later `git pull` changes the files and not what runs here.
VERSIONS = versions()
MARKED, FAILED, UNFIT = "marked", "failed", "unfit"  # the last: this machine can't mark anything


class Seat:
    """The pool of this process, of the run that it marks for."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._run = ""
        self._pool: Pool | None = None
        self._over: set[str] = set()

    def mark(self, order: dict[str, Any], place: Path) -> tuple[str, str]:
        """Mark what `Far` ordered: MARKED and a Result's JSON, or FAILED or UNFIT and why.

        place: a folder for what was handed in, as long as it is marked.
        """
        try:
            with self._turn, tempfile.TemporaryDirectory(dir=place, ignore_cleanup_errors=True) as folder:
                task = _unpacked(order, Path(folder))
                [result] = self._pool_of(order).mark([task])
                return MARKED, result.to_json()
        except (SandboxMissing, SandboxFailed) as error:
            return UNFIT, str(error)
        except Exception as error:
            return FAILED, f"{type(error).__name__}: {error}"

    def leave(self, run: str) -> None:
        """End what is marked for this run, and all its processes."""
        self._over.add(run)
        if self._run == run:
            self.close()

    def close(self) -> None:
        """End all processes, also those at work."""
        pool, self._run, self._pool = self._pool, "", None
        if pool:
            pool.close()

    def _pool_of(self, order: dict[str, Any]) -> Pool:
        if self._run != order["run"]:
            self.close()
            patience, limits = Patience(**order["patience"]), Limits(**order["limits"])
            self._pool = Pool(Path("/"), 1, order["unsafe"], order["secret"], patience, limits)
            self._run = order["run"]
        if order["run"] in self._over:  # it was left while the pool was being opened
            self.close()
            raise RuntimeError("the run is over")
        return self._pool


def _unpacked(order: dict[str, Any], folder: Path) -> Task:
    submission, release = folder / "submission", folder / "release"
    unpack(order["submission"], submission)
    unpack(order["release"], release)
    return Task(**order["task"], folder=submission, release=release)


_seat = Seat()
atexit.register(_seat.close)


def about() -> dict[str, str]:
    """The versions that mark here; see versions."""
    return VERSIONS


def work(order: dict[str, Any]) -> tuple[str, str]:
    """See Seat.mark. In the worker's own folder: after a worker that was killed, Dask cleans up there."""
    from distributed import get_worker

    return _seat.mark(order, Path(get_worker().local_directory))


def leave(run: str) -> None:
    """See Seat.leave."""
    _seat.leave(run)
