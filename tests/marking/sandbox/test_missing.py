"""Systems without a sandbox, and what the marker reads there."""
import contextlib
from pathlib import Path

import pytest

from grader.marking.errors import SandboxFailed, SandboxMissing
from grader.marking.sandbox import Sandbox, bubblewrap, separate_user, warm_process
from tests.marking.sandbox.commanded import sandbox
from tests.marking.sandbox.machines import in_a_system_with
from tests.patience import until

UNSAFE = ", or mark with `--unsafe`, which lets students' code read and change all your files."


NOT_ROOT = "import os; os.geteuid = lambda: 1000; "  # who could make separate users


def test_without_bubblewrap_it_says_how_to_get_it(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    with pytest.raises(SandboxMissing) as caught:
        sandbox()
    assert str(caught.value) == (
        "Marking runs students' code in a sandbox made by bubblewrap, and this machine has no `bwrap`: "
        "install it with `sudo apt install bubblewrap`" + UNSAFE
    )


def test_to_root_it_says_why_separate_users_do_not_work_either(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("os.geteuid", lambda: 0)
    monkeypatch.setattr(separate_user, "_try_as_user", lambda visible, hidden: "other users can't read /x")
    with pytest.raises(SandboxMissing) as caught:
        sandbox()
    assert str(caught.value).endswith(
        f"{UNSAFE} Separate users don't work either: other users can't read /x."
    )


def test_on_another_architecture_it_says_where_to_mark(monkeypatch):
    monkeypatch.setattr("platform.machine", lambda: "aarch64")
    with pytest.raises(SandboxMissing) as caught:
        sandbox()
    assert str(caught.value) == (
        "The sandbox filters system calls by their numbers on x86_64, and this machine is aarch64: "
        "mark on a Linux x86_64 machine."
    )


@pytest.mark.parametrize("namespaces", [0, 2])  # none for bubblewrap; enough for it, and none inside
def test_where_user_namespaces_are_forbidden_it_says_how_to_allow_them(namespaces):
    attempt = NOT_ROOT + "from tests.marking.sandbox.commanded import sandbox; sandbox()"
    done = in_a_system_with(namespaces, attempt)
    error = done.stderr.splitlines()[-1]
    assert error.startswith(
        "grader.marking.errors.SandboxMissing: This system doesn't let bubblewrap make a sandbox ("
    )
    way = "Allow user namespaces with `sudo sysctl user.max_user_namespaces=10000`"
    if namespaces:
        way = "In a container, allow user namespaces, as with `docker run --security-opt seccomp=unconfined`"
        assert "([Errno 28] unshare: No space left on device)" in error
    assert error.endswith(f"). {way}{UNSAFE}")


@pytest.mark.parametrize(
    ("files", "way"),
    [
        (
            {"proc/sys/kernel/apparmor_restrict_unprivileged_userns": "1"},
            "Allow user namespaces with `sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0`",
        ),
        (
            {
                "proc/sys/kernel/apparmor_restrict_unprivileged_userns": "1",
                "etc/apparmor.d/bwrap-userns-restrict": "profile bwrap /usr/bin/bwrap {}",
            },
            "Allow user namespaces with `sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0` and "
            "`sudo apparmor_parser -R /etc/apparmor.d/bwrap-userns-restrict`",
        ),
        (
            {"proc/sys/kernel/unprivileged_userns_clone": "0"},
            "Allow user namespaces with `sudo sysctl kernel.unprivileged_userns_clone=1`",
        ),
        (
            {"proc/sys/user/max_user_namespaces": "10000"},
            "In a container, allow user namespaces, as with `docker run --security-opt seccomp=unconfined`",
        ),
    ],
)
def test_the_way_out_depends_on_the_system(tmp_path, files, way):
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text + "\n")
    assert str(bubblewrap.forbidden("bwrap: No permission", tmp_path)) == (
        f"This system doesn't let bubblewrap make a sandbox (bwrap: No permission). {way}{UNSAFE}"
    )


@pytest.mark.parametrize("unsafe", [False, True])
def test_a_warm_process_that_dies_early_is_reported_with_its_last_words(tmp_path, unsafe):
    (tmp_path / "quitter.py").write_text("import os; os.write(2, b'no more'); os._exit(1)")
    with pytest.raises(SandboxFailed) as caught:
        Sandbox("quitter:main", preload=(), imports=[tmp_path], unsafe=unsafe)
    assert str(caught.value) == "The sandbox ended before it was ready. Its last output: no more"


def test_a_file_to_read_that_is_not_there_is_named(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        sandbox(readable=[tmp_path / "data.csv"])
    assert str(caught.value) == f"[Errno 2] No such file or directory: '{tmp_path}/data.csv'"


def test_a_warm_process_that_falls_silent_is_given_up(monkeypatch, tmp_path):
    (tmp_path / "silent.py").write_text("import signal; signal.pause()")
    monkeypatch.setattr(warm_process, "START_S", 0.01)
    with pytest.raises(SandboxFailed) as caught:
        Sandbox("silent:main", preload=(), imports=[tmp_path])
    until(lambda: not processes_with(str(tmp_path)), "it to be gone")
    assert str(caught.value) == "The sandbox was not ready after 0.01 s: is this machine too busy?"


def processes_with(text: str) -> list[Path]:
    """Those of this machine that have a text in their environment."""
    found = []
    for place in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it may have ended
            found += [place] * (text.encode() in (place / "environ").read_bytes())
    return found
