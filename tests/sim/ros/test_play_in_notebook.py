"""In a real kernel: something plays while other cells run, the Stop button ends it, and nothing is left."""

import pytest
from jupyter_client.manager import start_new_kernel

from sim import run
from tests.patience import PATIENCE, until
from tests.students.engine import mains

SNAPSHOT = """
import gc, asyncio, os, signal, ipywidgets
from rclpy.node import Node
def left():
    gc.collect()
    tasks = [task for task in asyncio.all_tasks() if "Player" in repr(task)]
    nodes = [thing for thing in gc.get_objects() if issubclass(type(thing), Node)]
    counts = [len(os.listdir(f"/proc/self/{kind}")) for kind in ("task", "fd")]
    return *counts, len(nodes), len(tasks), len(ipywidgets.widgets.widget._instances)
"""


class Kernel:
    """A kernel, and what its cells show."""

    def __init__(self, manager, client):
        self.manager, self.client = manager, client
        self("import time\nfrom sim import Teleop, play, run\nfrom tests.students.engine import mains")

    def __call__(self, source):
        """Run a cell; what it printed, kinds of what it displayed, and the name of its error."""
        self.displayed, self.errors, printed = [], [], []

        def show(message):
            kind, content = message["msg_type"], message["content"]
            if kind == "stream":
                (printed if content["name"] == "stdout" else self.errors).append(content["text"])
            elif kind in ("display_data", "update_display_data", "execute_result"):
                self.displayed.append((kind, set(content["data"])))

        reply = self.client.execute_interactive(source, timeout=PATIENCE, output_hook=show)["content"]
        self.error = reply.get("ename")
        return "".join(printed)

    def begin(self, source):
        """Begin a cell, and wait until it prints something: before that, an interrupt may get lost."""
        cell, reply = self.client.execute(source), {}
        while (reply.get("msg_type"), reply.get("parent_header", {}).get("msg_id")) != ("stream", cell):
            reply = self.client.get_iopub_msg(timeout=PATIENCE)

    def eventually(self, expression):
        """Ask until it is true; between the questions the kernel is idle."""
        until(lambda: self(f"print(bool({expression}))") == "True\n", expression)


@pytest.fixture(scope="module")
def kernel():
    # Its history is a database, which has a file more open in one cell of three, while it saves.
    no_history = ["--HistoryManager.enabled=False"]
    manager, client = start_new_kernel(
        startup_timeout=PATIENCE, kernel_name="python3", extra_arguments=no_history
    )
    yield Kernel(manager, client)
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def test_it_plays_on_while_other_cells_run(kernel):
    kernel("player = play(mains.classic, world='room', seconds=900_000, quiet=True)\nplayer")
    assert [kind for kind, _ in kernel.displayed] == ["display_data"]
    assert "application/vnd.jupyter.widget-view+json" in kernel.displayed[0][1]
    kernel.eventually("player.recording.stamp > 0.5")
    kernel("import matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.show()")
    assert kernel.displayed == [("display_data", {"image/png", "text/plain"})]
    kernel("1 / 0")
    assert kernel.error == "ZeroDivisionError"
    kernel("before = player.recording.stamp")
    kernel.eventually("player.recording.stamp > before + 0.3")
    assert kernel("print(run(mains.classic, seconds=3, quiet=True).digest)") == (
        run(mains.classic, seconds=3, quiet=True).digest + "\n"
    )
    usual = run(mains.classic, world="room", seconds=5, quiet=True).digest
    kernel(
        "player.speed = float('inf')\n"
        "player = play(mains.classic, world='room', seconds=5, quiet=True)\n"
        "player.pause()"  # its end is to come in the next cell
    )
    assert kernel("print(player.result().digest)") == usual + "\n"
    assert [("update_display_data", {"text/html", "text/plain"})] == kernel.displayed
    assert kernel.errors == []


def test_a_cell_can_wait_for_it(kernel):
    kernel("recording = await play(mains.Counter, seconds=1, speed=5, quiet=True)")
    assert kernel("print(recording.ended.reason)") == "time\n"


def test_the_stop_button_ends_it_while_the_kernel_is_idle(kernel):
    kernel("player = play(mains.classic, world='room', seconds=900_000, quiet=True)")
    kernel.eventually("player.recording.stamp > 0.2")
    kernel.manager.interrupt_kernel()
    kernel.eventually("player.over")
    assert kernel("print(player.recording.ended.detail)") == "The user interrupted the run.\n"
    kernel("from sim.ros.engine import interrupts")
    kernel.eventually("not interrupts._installed")


def test_the_stop_button_stops_another_cell_and_not_the_play(kernel):
    kernel("player = play(mains.classic, world='room', seconds=900_000, quiet=True)")
    kernel.begin("print('begun', flush=True)\nwhile True: time.sleep(9)")
    kernel.manager.interrupt_kernel()
    kernel("before = player.recording.stamp")
    assert kernel("print(player.over)") == "False\n"
    kernel.eventually("player.recording.stamp > before + 0.2")
    kernel("player.stop()")


def test_a_busy_cell_makes_no_jump(kernel):
    kernel("player = play(mains.classic, world='room', seconds=900_000, quiet=True)")
    kernel.eventually("player.recording.stamp > 0.2")
    printed = kernel(
        "import asyncio\n"
        "before, begin = player.recording.stamp, time.monotonic()\n"
        "time.sleep(3)\n"
        "await asyncio.sleep(0.3)\n"
        "print(player.recording.stamp - before, time.monotonic() - begin)\n"
        "player.stop()"
    )
    simulated, real = map(float, printed.split())
    assert 0 <= simulated < real - 2  # it played in what came after the 3 s


@pytest.mark.parametrize("number", [10, pytest.param(50, marks=pytest.mark.soak)])
def test_many_cells_that_play_leave_nothing(kernel, number):
    kernel(SNAPSHOT)
    cell = "player = play(Teleop, mains.classic, world='room', seconds=900_000, quiet=True)"
    for _ in range(3):
        kernel(cell)
    kernel("player.stop()")
    kernel.eventually("left()[3] == 0")
    before = kernel("print(left())")
    for _ in range(number):
        kernel(cell)
    kernel("player.stop()")
    kernel.eventually(f"left() == {before}")
    assert kernel.errors == []


def test_a_restarted_kernel_works(kernel):
    kernel("player = play(mains.classic, world='room', seconds=900_000, quiet=True)")
    kernel.manager.restart_kernel()
    kernel.client.wait_for_ready(timeout=PATIENCE)
    assert kernel("from sim import run\nprint(run(seconds=1).ended.reason)") == "time\n"
