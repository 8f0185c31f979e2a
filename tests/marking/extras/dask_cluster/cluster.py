"""A Dask scheduler with workers, all real processes on this machine."""
import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path

import psutil
from distributed import Client

from tests.marking.tiny import ROOT
from tests.patience import PATIENCE, until


class Cluster:
    """A scheduler at `address`; what its processes say goes to files in `folder`."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self.folder, self.processes = folder, []
        options = ("--host", "127.0.0.1", "--port", "0", "--scheduler-file", "scheduler.json")
        self.scheduler = self._start("dask_scheduler", *options)
        self.address = until(self._published_address, "the scheduler")

    def worker(self, **environment: str) -> subprocess.Popen:
        """Start a worker; no one starts it again."""
        place = str(self.folder / "dask")
        options = ("--no-nanny", "--nthreads", "1", "--local-directory", place)
        return self._start("dask_worker", self.address, *options, **environment)

    def with_workers(self, number: int) -> None:
        """See to it that so many are there, at least."""
        running = [process for process in self.processes if process.poll() is None]
        for _ in range(number + 1 - len(running)):
            self.worker()
        with Client(self.address, timeout=PATIENCE, set_as_default=False) as client:
            client.wait_for_workers(number, timeout=PATIENCE)

    def children(self) -> list[psutil.Process]:
        """The processes that the workers have started, with their children."""
        return [child for pid in self._pids().values() for child in psutil.Process(pid).children(True)]

    def kill(self, address: str) -> None:
        """End the worker at this address at once."""
        pid = self._pids()[address]
        process = next(process for process in self.processes if process.pid == pid)
        process.kill()
        process.wait()

    def close(self) -> None:
        # The scheduler last: a worker that gets a signal from both at once may hang.
        for some in (self.processes[1:], self.processes[:1]):
            for process in some:
                process.terminate()
            for process in some:
                process.wait(PATIENCE)

    def _pids(self) -> dict[str, int]:
        with Client(self.address, timeout=PATIENCE, set_as_default=False) as client:
            return client.run(os.getpid)

    def _published_address(self) -> str:
        """The address in the file that the scheduler writes; "" while it is not all there."""
        assert self.scheduler.poll() is None, (self.folder / "0.log").read_text()
        with contextlib.suppress(OSError, ValueError):
            return json.loads((self.folder / "scheduler.json").read_text())["address"]
        return ""

    def _start(self, program: str, *options: str, **environment: str) -> subprocess.Popen:
        command = [sys.executable, "-m", f"distributed.cli.{program}", *options, "--no-dashboard"]
        with open(self.folder / f"{len(self.processes)}.log", "w") as log:
            everything = {**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(self.folder), **environment}
            process = subprocess.Popen(command, cwd=self.folder, env=everything, stdout=log, stderr=log)
        self.processes.append(process)
        return process
