"""What a process and all that it started use together."""

import os
import subprocess
import sys

from grader.marking.sandbox.process_tree import tree_usage

CHILD = (
    "import threading; threading.Thread(target=input).start(); held = bytearray(50_000_000); "
    "print(flush=True); input()"
)


def test_children_count_and_strangers_do_not():
    processes = os.open("/proc", os.O_RDONLY)
    try:
        alone = tree_usage(os.getpid(), processes)
        with subprocess.Popen(
            [sys.executable, "-c", CHILD], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        ) as child:
            child.stdout.readline()
            together, own = tree_usage(os.getpid(), processes), tree_usage(child.pid, processes)
            child.kill()
    finally:
        os.close(processes)
    assert own.threads == 2
    assert own.memory_mb > 40
    assert together.threads == alone.threads + 2
    assert together.memory_mb > alone.memory_mb + 40
    assert together.cpu_s >= alone.cpu_s > 0


def test_who_is_gone_uses_nothing():
    processes = os.open("/proc", os.O_RDONLY)
    with subprocess.Popen([sys.executable, "-c", ""]) as child:
        child.wait()
    assert tree_usage(child.pid, processes).threads == 0
    os.close(processes)
