"""What a sandbox is for those who use it: confined processes start warm, answer, end, and say how."""
import socket
import subprocess
from pathlib import Path

import pytest

from grader.marking.errors import SandboxFailed
from grader.marking.sandbox import Sandbox, linux
from tests.marking.sandbox.commanded import sandbox
from tests.patience import PATIENCE


def test_a_process_starts_in_a_home_of_its_own_as_a_student(commanded):
    seen = commanded.ask("import os; answer = [os.getcwd(), os.environ['HOME'], os.getuid(), os.listdir()]")
    assert seen == ["/student", "/student", 1000, []]


def test_a_process_that_returns_has_exited(commanded):
    commanded.wire.shutdown(socket.SHUT_WR)
    ending = commanded.ending()
    assert (ending.kind, ending.code, ending.detail) == ("exited", 0, "The process ended by itself.")
    assert ending.peak_mb > 10


def test_its_memory_is_known_while_it_runs_and_afterwards(commanded):
    before = commanded.process.memory()
    commanded.ask("held = bytearray(100_000_000)")
    assert commanded.process.memory() > before + 90
    commanded.process.kill()
    assert commanded.ending().peak_mb > before + 90
    assert commanded.process.memory() == commanded.ending().peak_mb


def test_what_it_writes_to_stderr_last_is_kept(commanded):
    commanded.tell("import sys; print('careful', file=sys.stderr); sys.exit(3)")
    ending = commanded.ending()
    assert (ending.kind, ending.code, ending.stderr) == ("exited", 3, "careful")
    assert ending.detail == "The process ended by itself, with exit status 3."


def test_waiting_for_one_that_runs_takes_as_long_as_said(commanded):
    with pytest.raises(TimeoutError, match=r"^the process still runs after 0 s$"):
        commanded.process.wait(0)


def test_the_socket_is_handed_over(usual_sandbox, make_commanded):
    parent_end, child_end = socket.socketpair()
    process = usual_sandbox.start(child_end)
    assert child_end.fileno() == -1
    parent_end.close()
    assert process.wait(PATIENCE).kind == "exited"


def test_a_closed_sandbox_starts_no_process():
    box = sandbox()
    box.close()
    box.close()
    with pytest.raises(SandboxFailed, match=r"^This sandbox is closed\.$"):
        box.start(socket.socketpair()[0])


def test_an_import_that_fails_is_named():
    with pytest.raises(SandboxFailed) as caught:
        Sandbox("nowhere:main", preload=())
    assert str(caught.value) == (
        "The sandbox could not import what it needs: ModuleNotFoundError: No module named 'nowhere'"
    )


MINE = Path("/proc/self/personality")
# Of Python itself: where libraries lie that it loads later depends on what else was allocated.
WHERE = """
import os, sys
code = os.path.realpath(sys.executable), "/libpython", "/libc.so"
with open("/proc/self/maps") as maps:
    answer = sorted({line.split("-")[0] for line in maps if any(name in line for name in code)})
"""


@pytest.mark.skipif(
    subprocess.run(["setarch", "-R", "true"], check=False).returncode != 0,
    reason="this system lets no one choose: it is a container, as it seems",
)
def test_code_lies_at_the_same_addresses_in_and_outside_the_sandbox(usual_sandbox, make_commanded):
    before = MINE.read_text()
    with sandbox(unsafe=True) as box:
        outside = make_commanded(box)
        assert len(outside.ask(WHERE)) > 5
        assert outside.ask(WHERE) == make_commanded(usual_sandbox).ask(WHERE)
        outside.leave()
    assert MINE.read_text() == before


def test_where_the_system_forbids_it_a_process_starts_at_any_addresses(monkeypatch, make_commanded):
    class Forbidding:
        def personality(self, wanted) -> int:
            return 0 if wanted.value == 0xFFFFFFFF else -1

    monkeypatch.setattr(linux, "_libc", Forbidding())
    with sandbox(unsafe=True) as box:
        commanded = make_commanded(box)
        assert commanded.ask("answer = open('/proc/self/personality').read()") == "00000000\n"
        commanded.leave()


def test_what_is_preloaded_is_compiled_once_and_what_comes_later_leaves_nothing(tmp_path, make_commanded):
    for name in ("early", "later"):
        (tmp_path / f"{name}.py").write_text("import sys; kept = sys.dont_write_bytecode")
    imports = [Path(__file__).parent, tmp_path]
    with Sandbox("entries:obey", preload=["early"], unsafe=True, imports=imports) as box:
        commanded = make_commanded(box)
        assert commanded.ask("import early, later; answer = [early.kept, later.kept]") == [False, True]
        assert commanded.ask("import os; answer = os.environ['PYTHONDONTWRITEBYTECODE']") == "1"
        commanded.leave()
    assert [path.name.split(".")[0] for path in tmp_path.glob("__pycache__/*")] == ["early"]
