"""A handle on the warm process in the sandbox."""

import contextlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
from typing import IO, Any

from grader.marking.errors import SandboxFailed, SandboxMissing
from grader.marking.sandbox import bubblewrap, linux, separate_user
from grader.marking.sandbox.confined_process import ConfinedProcess
from grader.marking.sandbox.confinement import BUBBLEWRAP, USER

START_S = 600.0  # for the imports, which take 5 s on a machine that is not busy
STDERR_BYTES = 2000  # of its stderr that an error shows


class WarmProcess:
    """Starts the fork server and requests confined processes from it. Thread-safe."""

    def __init__(self, order: dict[str, Any]) -> None:
        """Start it and wait until it is warm. Raises SandboxMissing or SandboxFailed."""
        self._ended = False
        self._pidfd = -1
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()
        # The home of confined processes without a sandbox.
        self._folder = tempfile.TemporaryDirectory(prefix="confined-", ignore_cleanup_errors=True)
        self._kind = order["kind"]
        if self._kind == USER:
            os.chmod(self._folder.name, 0o711)  # each has a folder in it, of its own user
        self._control, child_end = socket.socketpair(type=socket.SOCK_SEQPACKET)
        with tempfile.TemporaryFile() as errors:
            try:
                with child_end:
                    self._process = process = _spawn(order, child_end, errors, self._folder.name)
                self._await(process, order, errors)
            except BaseException:
                self.end()
                raise

    def _await(self, process: subprocess.Popen[bytes], order: dict[str, Any], errors: IO[bytes]) -> None:
        self._control.settimeout(START_S)
        try:
            self._control.send(json.dumps(order).encode())
            answer, descriptors, _, _ = socket.recv_fds(self._control, 1 << 16, 1)
        except ConnectionError:
            answer, descriptors = b"", []
        except TimeoutError:
            text = f"The sandbox was not ready after {START_S:g} s: is this machine too busy?"
            raise SandboxFailed(text) from None
        self._control.settimeout(None)
        if not answer:
            process.wait()
            errors.seek(0)
            tail = errors.read()[-STDERR_BYTES:].decode(errors="replace").strip()
            raise bubblewrap.forbidden(tail) if tail.startswith("bwrap: ") else SandboxFailed(
                f"The sandbox ended before it was ready. Its last output: {tail or 'nothing'}"
            )
        [self._pidfd] = descriptors
        report = json.loads(answer)
        if "forbidden" in report and order["kind"] == USER:
            raise SandboxMissing(f"Separate users don't work on this machine: {report['forbidden']}.")
        if "forbidden" in report:
            raise bubblewrap.forbidden(report["forbidden"])
        if "failed" in report:
            raise SandboxFailed(f"The sandbox could not import what it needs: {report['failed']}")
        linux.run_first(self._pidfd)

    def start(self, wire: socket.socket) -> ConfinedProcess:
        """Return a new confined process that has `wire`. Raises SandboxFailed."""
        parent_end, child_end = socket.socketpair(type=socket.SOCK_SEQPACKET)
        parent_end.settimeout(START_S)
        try:
            with child_end, self._lock:
                socket.send_fds(self._control, [b"start"], [wire.fileno(), child_end.fileno()])
            answer, descriptors, _, _ = socket.recv_fds(parent_end, 1 << 16, 1)
        except OSError:
            answer, descriptors = b"", []
        if descriptors:
            return ConfinedProcess(descriptors[0], parent_end)
        parent_end.close()
        reason = json.loads(answer)["failed"] if answer else "it did not answer"
        raise SandboxFailed(f"The sandbox could not start a process: {reason}")

    def alive(self, wait_s: float = 0.0) -> bool:
        """Return whether it still runs after `wait_s` seconds."""
        with self._lock:
            if self._ended:
                return False
            poll = select.poll()
            poll.register(self._pidfd, select.POLLIN)
            return not poll.poll(1000 * wait_s)

    def end(self) -> None:
        """Kill it, and with it every confined process. Safe to call again."""
        with self._lock:
            if self._ended:
                return
            self._ended = True
            self._control.close()
            with contextlib.suppress(ProcessLookupError):
                if self._pidfd >= 0:
                    signal.pidfd_send_signal(self._pidfd, signal.SIGKILL)
                    os.close(self._pidfd)
                elif self._process:
                    self._process.kill()
            if self._process:
                self._process.wait()
            if self._kind == USER:
                separate_user.clear_unused()
            self._folder.cleanup()


def _spawn(
    order: dict[str, Any], child_end: socket.socket, errors: IO[bytes], folder: str
) -> subprocess.Popen[bytes]:
    module = "grader.marking.sandbox.fork_server"
    program = [sys.executable, "-P", "-s", "-m", module, str(child_end.fileno())]
    sandboxed = order["kind"] == BUBBLEWRAP
    # A judge and a student's process share a core: with equal addresses its branch predictions hold in both.
    with linux.same_addresses():
        return subprocess.Popen(
            bubblewrap.command(order["visible"], order["imports"], program) if sandboxed else program,
            env={} if sandboxed else bubblewrap.environment(folder, folder, order["imports"]),
            pass_fds=[child_end.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            start_new_session=True,  # Ctrl-C goes to the marker alone
        )
