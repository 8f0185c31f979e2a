"""A machine that has too little for one more inmate; ordinary users."""
import pytest

from grader.marking.sandbox import SandboxFailed, warm
from tests.marking.sandbox.machines import as_an_ordinary_user, in_a_system_with
from tests.marking.sandbox.prison import sandbox


def test_an_ordinary_user_has_the_same_sandbox():
    done = as_an_ordinary_user("""
        from tests.marking.sandbox.prison import Prisoner, sandbox
        with sandbox() as box:
            prisoner = Prisoner(box)
            print(prisoner.ask("import os; answer = [os.getcwd(), os.getuid(), os.listdir('/proc')]"))
            prisoner.leave()
    """)
    assert done.stdout == "['/student', 1000, ['self']]\n", done.stderr


def test_a_process_too_many_is_one_that_does_not_start():
    done = as_an_ordinary_user("""
        import resource
        from tests.marking.sandbox.prison import Prisoner, sandbox, warden

        with sandbox() as box:
            before = Prisoner(box)
            _, most = resource.prlimit(warden(box), resource.RLIMIT_NPROC)
            resource.prlimit(warden(box), resource.RLIMIT_NPROC, (1, most))
            try:
                Prisoner(box)
            except Exception as error:
                print(error)
            resource.prlimit(warden(box), resource.RLIMIT_NPROC, (most, most))
            after = Prisoner(box)
            print([prisoner.ask("answer = 'alive'") for prisoner in (before, after)])
            before.leave()
            after.leave()
    """)
    assert done.stdout.splitlines() == [
        "The sandbox could not start a process: [Errno 11] Resource temporarily unavailable",
        "['alive', 'alive']",
    ], done.stderr


def test_a_namespace_too_many_is_an_inmate_that_does_not_start():
    done = in_a_system_with(
        100,
        """
        from pathlib import Path
        from tests.marking.sandbox.prison import Prisoner, sandbox

        with sandbox() as box:
            before = Prisoner(box)
            Path("/proc/sys/user/max_user_namespaces").write_text("1")
            try:
                Prisoner(box)
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


def test_an_inmate_that_starts_too_late_is_given_up(prisoners, monkeypatch):
    with sandbox() as box:
        before = prisoners(box)
        monkeypatch.setattr(warm, "START_S", 1e-6)
        with pytest.raises(SandboxFailed) as caught:
            prisoners(box)
        assert str(caught.value) == "The sandbox could not start a process: it gave no answer"
        assert before.ask("answer = 'alive'") == "alive"
        before.leave()
