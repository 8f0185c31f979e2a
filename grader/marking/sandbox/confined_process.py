"""One student's process, as seen from outside."""

import contextlib
import json
import os
import re
import select
import signal
import socket
import threading
from pathlib import Path

from grader.marking.sandbox.limits import Ending

GONE = Ending("killed", "The process was killed: the cage around it broke.")


class ConfinedProcess:
    """A running student's process. `kill` may be called from any thread, the rest from one."""

    def __init__(self, pidfd: int, report: socket.socket) -> None:
        self.pid = int(re.search(r"^Pid:\s*(\S+)", Path(f"/proc/self/fdinfo/{pidfd}").read_text(), re.M)[1])
        self._pidfd = pidfd
        self._lock = threading.Lock()
        self._report = report
        self._ending: Ending | None = None

    def keep_to(self, core: int) -> None:
        """Let it run on this core alone, with what it starts from now on."""
        with contextlib.suppress(OSError):  # it may have ended
            if self.pid > 0:  # 0 would be ourselves
                os.sched_setaffinity(self.pid, {core})

    def kill(self) -> None:
        """End it with all it started, at once. Does nothing if it has ended."""
        with self._lock, contextlib.suppress(ProcessLookupError):
            if self._ending is None:  # else the descriptor may be somebody else's by now
                signal.pidfd_send_signal(self._pidfd, signal.SIGKILL)

    def wait(self, timeout: float | None = None) -> Ending:
        """Wait for its end, at most `timeout` seconds of the wall clock. Raises TimeoutError."""
        if self._ending is None:
            poll = select.poll()
            poll.register(self._report, select.POLLIN)
            if not poll.poll(None if timeout is None else 1000 * timeout):
                raise TimeoutError(f"the process still runs after {timeout:g} s")
            said = self._report.recv(1 << 16)
            self.kill()  # without a supervisor nobody else would
            self._report.close()
            with self._lock:
                self._ending = Ending(**json.loads(said)) if said else GONE
                os.close(self._pidfd)
        return self._ending

    def memory(self) -> float:
        """Return the most memory it had so far, in MB; 0 if nobody can tell."""
        if self._ending:
            return self._ending.peak_mb or 0.0
        with contextlib.suppress(OSError):
            status = Path(f"/proc/{self.pid}/status").read_text()
            if peak := re.search(r"^VmHWM:\s*(\d+) kB", status, re.M):
                return int(peak[1]) / 1024
        return 0.0
