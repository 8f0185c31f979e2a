"""A handle on one student's process."""

import contextlib
import json
import os
import re
import select
import signal
import socket
import threading
from pathlib import Path

from grader.marking.sandbox.resource_limits import ProcessEnd

GONE = ProcessEnd("killed", "The process was killed: its supervisor had died.")


class ConfinedProcess:
    """A running student's process. `kill` may be called from any thread, the rest from one."""

    def __init__(self, pidfd: int, report: socket.socket) -> None:
        self.pid = int(re.findall(r"^Pid:\s*(\S+)", Path(f"/proc/self/fdinfo/{pidfd}").read_text(), re.M)[0])
        self._pidfd = pidfd
        self._lock = threading.Lock()
        self._report = report
        self._ending: ProcessEnd | None = None

    def keep_to(self, core: int) -> None:
        """Pin it to this core, with all that it starts from now on."""
        with contextlib.suppress(OSError):  # it may have ended
            if self.pid > 0:  # 0 would be ourselves
                os.sched_setaffinity(self.pid, {core})

    def kill(self) -> None:
        """Kill it with all that it started. Does nothing if it has ended."""
        with self._lock, contextlib.suppress(ProcessLookupError):
            if self._ending is None:  # else the descriptor may belong to another process by now
                signal.pidfd_send_signal(self._pidfd, signal.SIGKILL)

    def wait(self, timeout: float | None = None) -> ProcessEnd:
        """Wait for its end, at most `timeout` seconds of the wall clock. Raises TimeoutError."""
        if self._ending is None:
            poll = select.poll()
            poll.register(self._report, select.POLLIN)
            if not poll.poll(None if timeout is None else 1000 * timeout):
                raise TimeoutError(f"the process still runs after {timeout:g} s")
            report = self._report.recv(1 << 16)
            self.kill()  # its supervisor may have died
            self._report.close()
            with self._lock:
                self._ending = ProcessEnd(**json.loads(report)) if report else GONE
                os.close(self._pidfd)
        return self._ending

    def memory(self) -> float:
        """Return its peak memory so far, in MB; 0 if that is unknown."""
        if self._ending:
            return self._ending.peak_mb or 0.0
        with contextlib.suppress(OSError):
            status = Path(f"/proc/{self.pid}/status").read_text()
            if peak := re.search(r"^VmHWM:\s*(\d+) kB", status, re.M):
                return int(peak[1]) / 1024
        return 0.0
