"""The workers of a Dask scheduler, and which of them can mark."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from grader.marking.extras.dask_cluster.on_worker import leave_run, worker_versions

if TYPE_CHECKING:
    from distributed import Client

HOW_TO_START = "Start it in a folder with this course, after `make setup`: `.venv/bin/dask worker SCHEDULER`."
SAME = "Bring both to the same version of the course with `git pull` and `make setup`, and start it again."


class Workers:
    """The workers of the scheduler that `client` is connected to.

    One that can't mark is excluded, and the reason is printed on stderr.
    """

    def __init__(self, client: Client) -> None:
        self._client = client
        self._here = worker_versions()
        self._fit: set[str] = set()
        self._unfit: set[str] = set()

    def present(self) -> set[str]:
        """The addresses of the connected workers that can mark. Raises OSError, RuntimeError."""
        known = set(self._client.nthreads())
        new = known - self._fit - self._unfit
        answers = self._client.run(worker_versions, workers=list(new), on_error="return") if new else {}
        for address, answer in answers.items():
            self._look_at(address, answer)
        return self._fit & known

    def leave_out(self, address: str, why: str) -> None:
        """Exclude this worker, and print why."""
        self._fit.discard(address)
        self._unfit.add(address)
        line = "\n" if sys.stderr.isatty() else ""  # on a terminal, the progress line is unfinished
        print(f"{line}The worker {address} is left out: {why}", file=sys.stderr, flush=True)

    def leave(self, run: str) -> None:
        """Stop the tasks of this run on all workers. Raises OSError, RuntimeError."""
        if present := self.present():
            self._client.run(leave_run, run, workers=list(present), on_error="ignore")

    def _look_at(self, address: str, answer: object) -> None:
        match answer:
            case OSError():
                pass  # it has gone, or will be checked again
            case Exception():
                self.leave_out(address, f"it can't load the course ({answer}). {HOW_TO_START}")
            case dict() if answer == self._here:
                self._fit.add(address)
            case _:
                self.leave_out(address, f"{_difference(answer, self._here)} {SAME}")


def _difference(there: Any, here: Mapping[str, str]) -> str:
    if not isinstance(there, Mapping):
        return "it reported no versions."
    names = [name for name in here if there.get(name) != here[name]]
    differences = [f"{name} {there.get(name, 'unknown')}, here {here[name]}" for name in names]
    return f"it has {'; '.join(differences)}."
