"""Bombs: what an inmate does to use everything up, and what it gets."""
import os

import pytest

from grader.marking.sandbox import Limits
from tests.marking.sandbox.prison import Prisoner, sandbox


@pytest.fixture
def tight(prisoners):
    """Make a prisoner under limits of the test's own."""
    boxes = []

    def make(entry: str = "inmates:obey", **limits: float) -> Prisoner:
        boxes.append(sandbox(limits=Limits(**limits), entry=entry))
        return prisoners(boxes[-1])

    yield make
    for box in boxes:
        box.close()


def test_too_much_memory_is_a_memory_error(prisoner):
    assert prisoner.ask("answer = len(bytearray(3_000_000_000))") == "MemoryError: "
    assert prisoner.ask("answer = 'alive'") == "alive"


def test_memory_in_small_pieces_is_limited_too(tight):
    prisoner = tight(memory_mb=500)
    assert prisoner.ask("held = [] \nwhile True: held.append(bytearray(100_000))") == "MemoryError: "
    assert prisoner.inmate.memory() < 500


def test_memory_that_nobody_misses_in_time_ends_it(tight):
    ending = tight("inmates:greedy", memory_mb=500).ending()
    assert (ending.kind, ending.code) == ("memory", 70)
    assert ending.detail == "The process needed more than the 500 MB of memory that are allowed."


def test_a_crash_for_want_of_memory_is_told_as_such(tight):
    prisoner = tight(memory_mb=500)
    prisoner.ask("held = [] \nwhile True: held.append(bytearray(100_000))")
    prisoner.tell("import os; os.abort()")
    assert prisoner.ending().kind == "memory"


def test_many_threads_get_no_more_of_the_machine_than_one(prisoner):
    flood = """
import hashlib, os, threading, time
data, began, before = bytes(1_000_000), time.perf_counter(), time.process_time()
def work():
    while time.process_time() < before + 2 * os.cpu_count():
        hashlib.sha256(data)
threads = [threading.Thread(target=work) for _ in range(50)]
for thread in threads: thread.start()
for thread in threads: thread.join()
answer = (time.process_time() - before) / (time.perf_counter() - began)
"""
    assert prisoner.ask(flood) < 1.5  # cores; a busy machine gives it less


def test_a_huge_file_is_too_large(tight):
    prisoner = tight(file_mb=4)
    said = prisoner.ask("open('big', 'wb').write(bytes(5_000_000))")
    assert said == "OSError: [Errno 27] File too large"


def test_many_files_fill_its_scratch_and_nothing_else(tight):
    prisoner = tight(file_mb=4, scratch_mb=10)
    said = prisoner.ask("for i in range(1000): open(f'/tmp/{i}', 'wb').write(bytes(1_000_000))")
    assert said == "OSError: [Errno 28] No space left on device"
    written = prisoner.ask("import os; answer = [name for name in os.listdir('/tmp') if name.isdigit()]")
    assert len(written) < 12
    assert prisoner.ask("open('/dev/shm/x', 'wb').write(bytes(1_000_000))") == said


def test_empty_files_are_counted(tight):
    prisoner = tight(scratch_files=100)
    said = prisoner.ask("for i in range(1000): open(str(i), 'w')")
    assert said.startswith("OSError: [Errno 28] No space left on device")
    assert 80 < prisoner.ask("import os; answer = len(os.listdir())") < 100


def test_open_files_are_counted(prisoner):
    said = prisoner.ask("held = [open('/dev/null') for _ in range(1000)]")
    assert said == "OSError: [Errno 24] Too many open files: '/dev/null'"


def test_a_flood_of_stderr_ends_at_the_largest_file(tight):
    prisoner = tight(file_mb=1)
    said = prisoner.ask("import os\nfor _ in range(100): os.write(2, b'x' * 100_000)")
    assert said == "OSError: [Errno 27] File too large"
    prisoner.inmate.kill()
    assert prisoner.ending().words == "x" * 4000


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
    prisoner = tight(threads=50)
    prisoner.tell(THREADS)
    if os.getuid():  # Linux itself does not count the threads of root
        assert prisoner.answer() == "RuntimeError: can't start new thread"
    else:
        ending = prisoner.ending()
        assert ending.kind == "threads"
        assert ending.detail == "The process had more than the 50 threads that are allowed."


def test_a_fork_bomb_makes_no_process(prisoner):
    assert prisoner.ask(FORKS) == 1000


def test_computing_without_end_is_stopped(tight):
    prisoner = tight(cpu_s=1)
    prisoner.tell("while True: pass")
    ending = prisoner.ending()
    assert ending.kind == "cpu"
    assert ending.detail == "The process computed for more than the 1 s that are allowed."
    assert ending.cpu_s > 1


def test_waiting_without_end_is_stopped(tight):
    prisoner = tight(wall_s=0.5)
    prisoner.tell("import threading; threading.Event().wait()")
    ending = prisoner.ending()
    assert ending.kind == "time"
    assert ending.detail == "The process ran for more than the 0.5 s that are allowed."


def test_limits_cannot_be_raised(prisoner):
    raised = "import resource; resource.setrlimit(resource.RLIMIT_{0}, (resource.RLIM_INFINITY,) * 2)"
    for name in ("AS", "FSIZE", "NOFILE", "NPROC"):
        assert prisoner.ask(raised.format(name)) == "ValueError: not allowed to raise maximum limit"
