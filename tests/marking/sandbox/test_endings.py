"""How confined processes end, and that none outlives its end."""

import gc
import os
import select
import signal
import subprocess
import sys
import textwrap

import pytest

from tests.marking.sandbox.commanded import fork_server, sandbox
from tests.patience import PATIENCE


@pytest.mark.parametrize(
    ("act", "kind", "detail"),
    [
        ("import os; os._exit(5)", "exited", "The process ended by itself, with exit status 5."),
        ("import ctypes; ctypes.string_at(0)", "crashed", "The process crashed: Segmentation fault."),
        ("import os; os.abort()", "crashed", "The process crashed: Segmentation fault."),
        ("import sys; sys.exit()", "exited", "The process ended by itself."),
        ("raise KeyboardInterrupt", "exited", "The process ended by itself, with exit status 1."),
    ],
)
def test_an_end_of_its_own_is_reported(commanded, act, kind, detail):
    commanded.tell(act)
    ending = commanded.ending()
    assert (ending.kind, ending.detail) == (kind, detail)


def test_an_error_that_leaves_the_entry_is_kept(commanded):
    commanded.tell("raise KeyboardInterrupt('stop it')")
    assert commanded.ending().stderr.endswith("KeyboardInterrupt: stop it")


def test_it_cannot_stop_itself(commanded):
    stop = "import os, signal; os.kill(os.getpid(), signal.SIGSTOP); answer = 'going on'"
    assert commanded.ask(stop) == "going on"


IGNORANT = "import signal; [signal.signal(s, signal.SIG_IGN) for s in signal.valid_signals() - {9, 19}]"


@pytest.mark.parametrize(
    "act",
    [
        "while True: pass",
        IGNORANT + "\nwhile True: pass",
        "import threading; [threading.Thread(target=threading.Event().wait).start() for _ in range(5)]",
        "wire.close(); import threading; threading.Event().wait()",
        "import os; keep = os.dup(3); os.closerange(0, 60); import threading; threading.Event().wait()",
    ],
)
def test_killing_ends_it_whatever_it_does(commanded, act):
    pidfd = os.pidfd_open(commanded.process.pid)
    commanded.tell(f"wire.sendall(b'.')\n{act}")
    assert commanded.wire.recv(1) == b"."
    commanded.process.kill()
    ending = commanded.ending()
    assert (ending.kind, ending.detail) == ("killed", "The process was killed from outside.")
    assert gone(pidfd)
    commanded.process.kill()


def test_closing_the_sandbox_ends_all(make_commanded):
    box = sandbox()
    held = [make_commanded(box) for _ in range(3)]
    box.close()
    assert {commanded.ending().kind for commanded in held} == {"killed"}


def test_when_the_warm_process_dies_a_new_one_takes_its_place(make_commanded):
    with sandbox() as box:
        before = make_commanded(box)
        os.kill(fork_server(box), signal.SIGKILL)
        assert before.ending().detail == "The process was killed: its supervisor had died."
        after = make_commanded(box)
        assert after.ask("answer = 'alive'") == "alive"
        after.leave()


def test_nothing_is_left_of_many(usual_sandbox, make_commanded):
    make_commanded(usual_sandbox).leave()
    gc.collect()  # files of earlier tests that only a garbage collection closes
    before = len(os.listdir("/proc/self/fd"))
    for _ in range(20):
        make_commanded(usual_sandbox).leave()
    gc.collect()
    assert len(os.listdir("/proc/self/fd")) <= before


@pytest.mark.parametrize("unsafe", [False, True])
def test_no_process_outlives_the_marker(unsafe):
    marker = f"""
        import socket, sys
        from tests.marking.sandbox.commanded import Commanded, sandbox
        box = sandbox(unsafe={unsafe})
        commanded = Commanded(box)
        commanded.tell("while True: pass")
        print(commanded.process.pid, flush=True)
        sys.stdin.read()
    """
    command = [sys.executable, "-c", textwrap.dedent(marker)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        pidfd = os.pidfd_open(int(process.stdout.readline()))
        process.kill()
    assert gone(pidfd)


def gone(pidfd: int) -> bool:
    poll = select.poll()
    poll.register(pidfd, select.POLLIN)
    ended = bool(poll.poll(1000 * PATIENCE))
    os.close(pidfd)
    return ended
