"""What remains of a hub whose processes are killed, and how the next one goes on."""
import json
import os
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import pytest
import requests

from grader.marking.extras.hub import leftovers, user_limits
from tests.marking.extras.hub.hub_client import HubClient, KernelClient
from tests.marking.extras.hub.real_hub import COURSE, RealHub, real_hub, reason_to_skip
from tests.patience import until

ALICE, INES = "hubtest-00", "hubtest-ines"
NOTEBOOK = "exercises/01_nodes/nodes.ipynb"
PROXY, CULLER, FORMGRADER = leftovers.OWN

pytestmark = [pytest.mark.soak, pytest.mark.skipif(bool(reason_to_skip()), reason=reason_to_skip())]


@pytest.fixture(scope="module")
def hub() -> Iterator[RealHub]:
    with real_hub(1) as running:
        yield running


@pytest.fixture
def kernel(hub: RealHub) -> Iterator[str]:
    """The id of a kernel of Alice that has a variable `answer`."""
    kernel = hub.client(ALICE).start_kernel(NOTEBOOK)
    kernel.run("answer = 41")
    yield kernel.kernel


def next_answer(hub: RealHub, kernel: str) -> str:
    """What Alice's kernel prints after she has logged in again."""
    return KernelClient(hub.client(ALICE), kernel).run("answer += 1; print(answer)")["text"].strip()


def hub_answers(hub: RealHub) -> bool:
    with suppress(requests.ConnectionError):
        return requests.get(f"{hub.address}/hub/api").ok
    return False


def formgrader_answers(hub: RealHub) -> bool:
    session = HubClient(hub.address, INES, hub.passwords[INES]).session
    page = session.get(f"{hub.address}/services/{COURSE}/")
    return page.ok and page.url.endswith("formgrader/manage_assignments")


def make_hub(hub: RealHub, *options: str) -> subprocess.CompletedProcess:
    """What a second `make hub` does."""
    command = [sys.executable, "-m", "grader", "hub", *options]
    return subprocess.run(command, cwd=hub.course, capture_output=True, text=True)


@contextmanager
def stranger() -> Iterator[int]:
    """A process of root that has nothing to do with the hub."""
    with subprocess.Popen(["sleep", "infinity"]) as process:
        yield process.pid
        assert process.poll() is None, "the hub ended it"
        process.kill()


def test_a_second_hub_in_the_same_folder_is_refused(hub):
    refused = make_hub(hub)
    assert (refused.returncode, refused.stderr) == (
        1, f"No hub: the hub of {hub.settings.folder} is already running, as process {hub.process.pid}: end it with "
           f"Ctrl-C or with `sudo kill {hub.process.pid}`, and run `make hub` again.\n"
    )


def test_after_a_killed_hub_the_next_one_has_the_kernels_with_their_variables(hub, kernel):
    hub.stop(signal.SIGKILL)
    left = leftovers.find(hub.settings)
    sentence = ("An earlier hub was killed: `make hub` ends what it left running, 3 processes. "
                "Servers of users, and their kernels, go on.\n")
    assert len(left) == 3
    assert make_hub(hub, "--check").stdout == f"{sentence}Nothing is missing.\n"
    logged = hub.start()
    assert sentence in logged
    assert f"{ALICE} still running" in logged
    assert "Traceback" not in logged
    assert not {*left} & {*leftovers.find(hub.settings)}
    assert next_answer(hub, kernel) == "42"
    assert formgrader_answers(hub)


@pytest.mark.parametrize("program", leftovers.OWN)
def test_the_hub_restarts_what_was_killed_and_kernels_go_on(hub, kernel, program):
    (killed,) = leftovers._processes(hub.settings, (program,))
    os.kill(killed, signal.SIGKILL)
    until(lambda: {*leftovers._processes(hub.settings, (program,))} - {killed}, program)
    until(lambda: hub_answers(hub), "the proxy")
    assert next_answer(hub, kernel) == "42"
    until(lambda: formgrader_answers(hub), "the formgrader")


def test_after_a_reboot_no_process_is_taken_for_one_of_before(hub, kernel):
    hub.stop(signal.SIGKILL)
    for process in leftovers.find(hub.settings):
        os.kill(process, signal.SIGKILL)
    user_limits.end_group(ALICE)
    folder = hub.settings.folder / "hub"
    with stranger() as process:
        (folder / leftovers.PROXY_PID).write_text(str(process))
        with closing(sqlite3.connect(folder / "jupyterhub.sqlite")) as book, book:
            book.execute("update spawners set state = ? where server_id is not null", [json.dumps({"pid": process})])
        logged = hub.start()
        assert f"{ALICE} appears to have stopped while the Hub was down" in logged
        assert hub.client(ALICE).start_kernel(NOTEBOOK).run("print(6 * 7)")["text"] == "42\n"
    assert "Traceback" not in hub.log.read_text()


def test_ctrl_c_ends_everything(hub, kernel):
    logged = hub.stop(signal.SIGINT)
    assert leftovers.find(hub.settings) == []
    everyone = [int(path.name) for path in Path("/proc").glob("[0-9]*")]
    assert [process for process in everyone if leftovers.is_process_of(process, ALICE)] == []
    assert "Traceback" not in logged
