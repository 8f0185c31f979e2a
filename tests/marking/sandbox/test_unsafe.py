"""Without a sandbox: the same process, limits and endings, without isolation."""
import os
from collections.abc import Iterator

import pytest

from grader.marking.sandbox import ResourceLimits, Sandbox
from tests.marking.sandbox.commanded import Commanded, sandbox


@pytest.fixture(scope="module")
def open_box() -> Iterator[Sandbox]:
    with sandbox(unsafe=True, limits=ResourceLimits(memory_mb=500, file_mb=1)) as box:
        yield box


@pytest.fixture
def free(open_box, make_commanded) -> Commanded:
    return make_commanded(open_box)


def test_it_starts_in_an_empty_folder_that_is_gone_afterwards(free):
    home = free.ask("import os, tempfile; open('x', 'w'); answer = os.getcwd()")
    assert free.ask("answer = [os.environ['HOME'], tempfile.gettempdir()]") == [home, home]
    assert os.listdir(home) == ["x"]
    free.leave()
    assert not os.path.exists(home)


def test_it_is_the_markers_own_user_and_sees_the_markers_files(free, tmp_path):
    (tmp_path / "mine").write_text("42")
    assert free.ask(f"import os; answer = [os.getuid(), open({str(tmp_path / 'mine')!r}).read()]") == [
        os.getuid(), "42",
    ]  # fmt: skip


def test_the_environment_is_as_clean_as_in_the_sandbox(monkeypatch, make_commanded):
    monkeypatch.setenv("COURSE_SECRET", "do not tell")
    with sandbox(unsafe=True) as box:
        commanded = make_commanded(box)
        assert "COURSE_SECRET" not in commanded.ask("import os; answer = dict(os.environ)")
        commanded.leave()


def test_limits_hold(free):
    assert free.ask("held = bytearray(3_000_000_000)") == "MemoryError: "
    assert free.ask("open('big', 'wb').write(bytes(2_000_000))") == "OSError: [Errno 27] File too large"
    assert free.ask("import os; os.fork()") == "PermissionError: [Errno 1] Operation not permitted"


def test_it_can_be_killed_and_says_how_it_ended(free):
    assert free.ask("answer = 1") == 1
    free.tell("while True: pass")
    free.process.kill()
    assert free.ending().kind == "killed"


def test_a_group_of_its_own_keeps_its_signals_from_the_others(open_box, make_commanded):
    attacker, other = make_commanded(open_box), make_commanded(open_box)
    attacker.tell("import os; os.kill(0, 9)")
    assert attacker.ending().kind == "killed"
    assert other.ask("answer = 'alive'") == "alive"
