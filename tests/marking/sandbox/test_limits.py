"""Bombs: what a confined process does to use everything up, and what it gets."""
import contextlib
import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import pytest

from grader.marking.sandbox import ResourceLimits, supervisor
from grader.marking.sandbox.process_tree import TreeUsage
from tests.marking.sandbox.commanded import Commanded, fork_server, sandbox, state
from tests.patience import until

TICK = 1 / os.sysconf("SC_CLK_TCK")  # s, to which Linux tells how long a process has computed


@pytest.fixture
def tight(make_commanded):
    """Make a commanded under limits of the test's own."""
    boxes = []

    def make(entry: str = "entries:obey", **limits: float) -> Commanded:
        boxes.append(sandbox(limits=ResourceLimits(**limits), entry=entry))
        return make_commanded(boxes[-1])

    yield make
    for box in boxes:
        box.close()


def test_too_much_memory_is_a_memory_error(commanded):
    assert commanded.ask("answer = len(bytearray(3_000_000_000))") == "MemoryError: "
    assert commanded.ask("answer = 'alive'") == "alive"


def test_memory_in_small_pieces_is_limited_too(tight):
    commanded = tight(memory_mb=500)
    assert commanded.ask("held = [] \nwhile True: held.append(bytearray(100_000))") == "MemoryError: "
    assert commanded.process.memory() < 500


def test_memory_that_grows_slowly_ends_it(tight):
    ending = tight("entries:greedy", memory_mb=500).ending()
    assert (ending.kind, ending.code) == ("memory", 70)
    assert ending.detail == "The process needed more than the 500 MB of memory that are allowed."


def test_a_crash_for_want_of_memory_is_reported_as_such(tight):
    commanded = tight(memory_mb=500)
    commanded.ask("held = [] \nwhile True: held.append(bytearray(100_000))")
    commanded.tell("import os; os.abort()")
    assert commanded.ending().kind == "memory"


class SimulatedMachine:
    """Runs one process on so many cores, for so many seconds of computing, in a time of its own.

    It takes the place of what the supervisor asks the system for. late: how much later each look comes (s).
    """

    def __init__(self, monkeypatch, cores: float, computes: float, late: float):
        self.now, self.used, self.cores, self.computes, self.late = 0.0, 0.0, cores, computes, late
        self.runs = True
        self.continued: list[tuple[float, float]] = []  # computed by then, and when
        monkeypatch.setattr(supervisor, "time", SimpleNamespace(monotonic=lambda: self.now))
        monkeypatch.setattr(supervisor, "select", SimpleNamespace(poll=lambda: self, POLLIN=0))
        monkeypatch.setattr(supervisor, "os", SimpleNamespace(kill=self.kill, sysconf=os.sysconf))
        monkeypatch.setattr(supervisor, "_read", self.read)
        monkeypatch.setattr(supervisor, "tree_usage", lambda *_: TreeUsage(self.used, threads=1))

    def register(self, descriptor: int, events: int) -> None:
        """As a poll object."""

    def poll(self, milliseconds: float) -> bool:
        passed = milliseconds / 1000 + self.late
        self.now, self.used = self.now + passed, self.used + self.runs * self.cores * passed
        return self.used > self.computes

    def kill(self, process: int, number: int) -> None:
        self.runs = number == signal.SIGCONT
        if self.runs:
            self.continued.append((self.used, self.now))

    def read(self, path: str, folder: int) -> bytes:
        fields = ["0"] * 11 + [str(int(self.used / TICK))] + ["0"] * 5 + ["50"]
        return f"7 (python) {' '.join(fields)}".encode()


@pytest.mark.parametrize("cores", [2, 4, 64])
@pytest.mark.parametrize("late", [0.0, 0.3])
def test_many_threads_get_no_more_of_the_machine_than_one(monkeypatch, cores, late):
    machine = SimulatedMachine(monkeypatch, cores, 500.0, late)
    assert supervisor._watch(7, 8, 9, ResourceLimits()) == ""
    assert len(machine.continued) > 3
    assert all(used <= supervisor.CORES * now + TICK for used, now in machine.continued)
    if not late:
        assert machine.continued[-1][0] == pytest.approx(supervisor.CORES * machine.now, abs=1 + TICK)


def test_one_thread_is_never_held_up(monkeypatch):
    machine = SimulatedMachine(monkeypatch, cores=1, computes=500.0, late=0.0)
    assert supervisor._watch(7, 8, 9, ResourceLimits()) == ""
    assert machine.continued == []


def test_a_process_that_has_had_more_than_its_share_is_stopped(monkeypatch):
    """A real one; here any share is too much, so that it stays stopped until it is killed."""
    monkeypatch.setattr(supervisor, "CORES", 1e-5)
    processes = os.open("/proc", os.O_RDONLY)
    busy = [sys.executable, "-c", "while True: pass"]
    with subprocess.Popen(busy) as process, ThreadPoolExecutor() as pool:
        pidfd = os.pidfd_open(process.pid)
        watch = pool.submit(supervisor._watch, process.pid, pidfd, processes, ResourceLimits())
        until(lambda: state(process.pid) == "T", "a process to be stopped")
        process.kill()
        assert watch.result() == ""
    os.close(pidfd)
    os.close(processes)


def test_a_huge_file_is_too_large(tight):
    commanded = tight(file_mb=4)
    answer = commanded.ask("open('big', 'wb').write(bytes(5_000_000))")
    assert answer == "OSError: [Errno 27] File too large"


def test_many_files_fill_its_scratch_and_nothing_else(tight):
    commanded = tight(file_mb=4, scratch_mb=10)
    answer = commanded.ask("for i in range(1000): open(f'/tmp/{i}', 'wb').write(bytes(1_000_000))")
    assert answer == "OSError: [Errno 28] No space left on device"
    written = commanded.ask("import os; answer = [name for name in os.listdir('/tmp') if name.isdigit()]")
    assert len(written) < 12
    assert commanded.ask("open('/dev/shm/x', 'wb').write(bytes(1_000_000))") == answer


def test_empty_files_are_counted(tight):
    commanded = tight(scratch_files=100)
    answer = commanded.ask("for i in range(1000): open(str(i), 'w')")
    assert answer.startswith("OSError: [Errno 28] No space left on device")
    assert 50 < commanded.ask("import os; answer = len(os.listdir())") < 100


def test_open_files_are_counted(commanded):
    answer = commanded.ask("held = [open('/dev/null') for _ in range(1000)]")
    assert answer == "OSError: [Errno 24] Too many open files: '/dev/null'"


def test_a_flood_of_stderr_ends_at_the_largest_file(tight):
    commanded = tight(file_mb=1)
    answer = commanded.ask("import os\nfor _ in range(100): os.write(2, b'x' * 100_000)")
    assert answer == "OSError: [Errno 27] File too large"
    commanded.process.kill()
    assert commanded.ending().stderr == "x" * 4000


FORKS = """
import os
answer = 0
for _ in range(1000):
    try:
        os.fork()
    except PermissionError:
        answer += 1
"""

THREADS = """
import threading
threading.stack_size(65536)
never = threading.Event()
for _ in range(5000):
    threading.Thread(target=never.wait, daemon=True).start()
never.wait()
"""


def test_a_thread_bomb_is_stopped(tight):
    commanded = tight(threads=50)
    commanded.tell(THREADS)
    if os.getuid():  # Linux itself does not count the threads of root
        assert commanded.answer() == "RuntimeError: can't start new thread"
    else:
        ending = commanded.ending()
        assert ending.kind == "threads"
        assert ending.detail == "The process had more than the 50 threads that are allowed."


def test_a_fork_bomb_makes_no_process(commanded):
    assert commanded.ask(FORKS) == 1000


@pytest.mark.skipif(bool(os.getuid()), reason="Linux itself counts the processes of other users")
def test_a_supervisor_runs_before_what_it_watches(make_commanded):
    with contextlib.closing(sandbox()) as box:
        commanded = make_commanded(box)
        own = commanded.ask("import os; answer = os.sched_getscheduler(0)")
        raised = commanded.ask("os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))")
        assert raised == "PermissionError: [Errno 1] Operation not permitted"
        server = fork_server(box)
        supervisors = Path(f"/proc/{server}/task/{server}/children").read_text().split()
        policies = [os.sched_getscheduler(int(pid)) for pid in supervisors]
        assert (own, policies[-1]) == (os.SCHED_OTHER, os.SCHED_RR)  # that of the trial may still be ending


def test_a_fork_bomb_of_programs_is_stopped(tight):
    commanded = tight(programs=True, threads=50)
    commanded.tell("import os\nwhile True: os.fork()")
    ending = commanded.ending()
    assert ending.kind in ("threads", "memory"), ending


def test_computing_without_end_is_stopped(tight):
    commanded = tight(cpu_s=1)
    commanded.tell("while True: pass")
    ending = commanded.ending()
    assert ending.kind == "cpu"
    assert ending.detail == "The process computed for more than the 1 s that are allowed."
    assert ending.cpu_s > 1


def test_waiting_without_end_is_stopped(tight):
    ending = tight(wall_s=0.1).ending()  # it waits for the first command
    assert ending.kind == "time"
    assert ending.detail == "The process ran for more than the 0.1 s that are allowed."


def test_programs_that_do_nothing_for_long_are_stopped(tight):
    commanded = tight(programs=True, idle_s=1.0)
    commanded.tell("import subprocess; subprocess.run(['sleep', '100000'])")
    ending = commanded.ending()
    assert ending.kind == "idle"
    assert ending.detail == "The process did nothing for more than the 1 s that are allowed."


@pytest.mark.parametrize(("cores", "kind"), [(1.0, "cpu"), (0.05, "cpu"), (0.001, "idle")])
def test_programs_that_compute_are_not_idle_however_busy_the_machine_is(monkeypatch, cores, kind):
    SimulatedMachine(monkeypatch, cores, computes=500.0, late=0.0)
    assert supervisor._watch(7, 8, 9, ResourceLimits(programs=True, idle_s=10.0, cpu_s=20)) == kind


def test_limits_cannot_be_raised(commanded):
    raised = "import resource; resource.setrlimit(resource.RLIMIT_{0}, (resource.RLIM_INFINITY,) * 2)"
    for name in ("AS", "FSIZE", "NOFILE", "NPROC"):
        assert commanded.ask(raised.format(name)) == "ValueError: not allowed to raise maximum limit"
