"""What a process and all that it started use together."""

import os
import signal
import subprocess
import sys

from grader.marking.sandbox.process_tree import tree_usage

CHILD = """
import threading, time
threading.Thread(target=input).start()
held = bytearray(50_000_000)
while time.process_time() < 0.05: pass
print(flush=True)
input()
"""
PARENT = f"""
import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", {CHILD!r}], stdin=sys.stdin, stdout=subprocess.PIPE)
child.stdout.readline()
print(child.pid, flush=True)
child.wait()
"""


def test_children_count_and_strangers_do_not():
    processes = os.open("/proc", os.O_RDONLY)
    try:
        with subprocess.Popen(
            [sys.executable, "-c", PARENT], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        ) as parent:
            child = int(parent.stdout.readline())
            own, together = tree_usage(child, processes), tree_usage(parent.pid, processes)
            os.kill(child, signal.SIGKILL)
    finally:
        os.close(processes)
    assert (own.threads, together.threads) == (2, 3)
    assert together.memory_mb > own.memory_mb > 40
    assert together.cpu_s >= own.cpu_s > 0


def test_who_is_gone_uses_nothing():
    processes = os.open("/proc", os.O_RDONLY)
    with subprocess.Popen([sys.executable, "-c", ""]) as child:
        child.wait()
    assert tree_usage(child.pid, processes).threads == 0
    os.close(processes)
