"""A machine that has too little for one more confined process; ordinary users."""
import pytest

from grader.marking.errors import SandboxFailed
from grader.marking.sandbox import warm_process
from tests.marking.sandbox.commanded import fork_server, sandbox, stopped
from tests.marking.sandbox.machines import as_an_ordinary_user, in_a_system_with


def test_an_ordinary_user_has_the_same_sandbox():
    done = as_an_ordinary_user("""
        from tests.marking.sandbox.commanded import Commanded, sandbox
        with sandbox() as box:
            commanded = Commanded(box)
            print(commanded.ask("import os; answer = [os.getcwd(), os.getuid(), os.listdir('/proc')]"))
            commanded.leave()
    """)
    assert done.stdout == "['/student', 1000, ['self']]\n", done.stderr


def test_a_process_too_many_is_one_that_does_not_start():
    done = as_an_ordinary_user("""
        import resource
        from tests.marking.sandbox.commanded import Commanded, fork_server, sandbox

        with sandbox() as box:
            before = Commanded(box)
            _, most = resource.prlimit(fork_server(box), resource.RLIMIT_NPROC)
            resource.prlimit(fork_server(box), resource.RLIMIT_NPROC, (1, most))
            try:
                Commanded(box)
            except Exception as error:
                print(error)
            resource.prlimit(fork_server(box), resource.RLIMIT_NPROC, (most, most))
            after = Commanded(box)
            print([commanded.ask("answer = 'alive'") for commanded in (before, after)])
            before.leave()
            after.leave()
    """)
    assert done.stdout.splitlines() == [
        "The sandbox could not start a process: [Errno 11] Resource temporarily unavailable",
        "['alive', 'alive']",
    ], done.stderr


def test_a_namespace_too_many_is_a_process_that_does_not_start():
    done = in_a_system_with(
        100,
        """
        from pathlib import Path
        from tests.marking.sandbox.commanded import Commanded, sandbox

        with sandbox() as box:
            before = Commanded(box)
            Path("/proc/sys/user/max_user_namespaces").write_text("1")
            try:
                Commanded(box)
            except Exception as error:
                print(error)
            print(before.ask("answer = 'alive'"))
            before.leave()
        """,
    )
    assert done.stdout.splitlines() == [
        "The sandbox could not start a process: [Errno 28] unshare: No space left on device",
        "alive",
    ], done.stderr


def test_a_process_that_starts_too_late_is_given_up(make_commanded, monkeypatch):
    with sandbox() as box:
        before = make_commanded(box)
        with stopped(fork_server(box)), monkeypatch.context() as patched:
            patched.setattr(warm_process, "START_S", 0.01)
            with pytest.raises(SandboxFailed) as caught:
                make_commanded(box)
            assert str(caught.value) == "The sandbox could not start a process: it did not answer"
            assert before.ask("answer = 'alive'") == "alive"
        after = make_commanded(box)
        assert [commanded.ask("answer = 'alive'") for commanded in (before, after)] == ["alive", "alive"]
        before.leave()
        after.leave()
