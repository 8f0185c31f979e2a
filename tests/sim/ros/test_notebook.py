"""In a notebook's kernel, with its event loop and its output threads, a run is what it is anywhere else."""

import nbformat
import pytest
from jupyter_client.manager import start_new_kernel
from nbclient import NotebookClient

from sim import run
from tests.patience import PATIENCE
from tests.students.engine import mains, output

CELLS = {
    "handlers": """
        import logging, sys
        logging.basicConfig(stream=sys.stdout)
        logging.getLogger("errors").addHandler(logging.StreamHandler())
        from sim import run
        from tests.students.engine import mains, output""",
    "digest": "print(run(mains.classic, world='room', seconds=5, quiet=True).digest)",
    "logging": """
        runs = [run(output.PythonLogging, seconds=5, quiet=True) for _ in range(20)]
        print({len(one.callbacks) for one in runs}, len({one.digest for one in runs}))""",
    "own": """
        import rclpy
        rclpy.init()
        node = rclpy.create_node("own")
        print(len(run(mains.Counter, seconds=2, quiet=True).logs), rclpy.ok())
        rclpy.spin_once(node, timeout_sec=0.0)
        node.destroy_node()
        rclpy.shutdown()""",
    "asyncio": """
        import asyncio
        def main():
            print(asyncio.run(asyncio.sleep(0, "slept")))
        run(main, seconds=1)""",
}


def dedented(source):
    return "\n".join(line.removeprefix("        ") for line in source.strip().splitlines())


@pytest.fixture(scope="module")
def shown():
    """What each cell shows on stdout."""
    cells = [nbformat.v4.new_code_cell(dedented(source)) for source in CELLS.values()]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, timeout=PATIENCE, startup_timeout=PATIENCE, kernel_name="python3").execute()
    return {
        name: "".join(o.text for o in cell.outputs if o.output_type == "stream" and o.name == "stdout")
        for name, cell in zip(CELLS, notebook.cells, strict=True)
    }


def test_a_run_is_equal_to_one_outside(shown):
    assert shown["digest"] == run(mains.classic, world="room", seconds=5, quiet=True).digest + "\n"


def test_logging_handlers_of_earlier_cells_hold_no_one_up(shown):
    callbacks = len(run(output.PythonLogging, seconds=5, quiet=True).callbacks)
    assert shown["logging"] == f"{{{callbacks}}} 1\n"


def test_the_users_own_rclpy_lives_on(shown):
    logs = len(run(mains.Counter, seconds=2, quiet=True).logs)
    assert shown["own"] == f"{logs} True\n"


def test_the_kernels_event_loop_is_not_the_nodes(shown):
    assert shown["asyncio"] == "slept\n"


def test_the_stop_button_stops_a_run_and_the_kernel_lives_on():
    manager, client = start_new_kernel(kernel_name="python3", startup_timeout=PATIENCE)
    try:
        client.execute_interactive("from sim import run\nfrom tests.students.engine import mains")
        tells = "until=lambda recording: recording.stamp == 1 and print('under way')"

        def stop(message):
            if message["msg_type"] == "stream":
                manager.interrupt_kernel()

        cell = f"run(mains.Counter, seconds=900_000, {tells}, quiet=True)"
        reply = client.execute_interactive(cell, timeout=PATIENCE, output_hook=stop)
        content = reply["content"]
        assert (content["ename"], content["evalue"]) == ("KeyboardInterrupt", "The run was interrupted.")
        assert client.execute_interactive("run(mains.Counter, seconds=1)")["content"]["status"] == "ok"
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
