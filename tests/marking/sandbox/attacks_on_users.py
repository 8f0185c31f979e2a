"""Attacks from a process that is only another user; test_separate_user.py runs them as in a container."""
import contextlib
import os
import signal
import socket
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

import pytest

import grader
from grader.marking.sandbox import ResourceLimits, bubblewrap, landlock, linux, seccomp, separate_user
from grader.marking.student_process.judge_only import FOLDERS
from grader.workspace.interfaces import TOOLS
from tests.marking.sandbox.commanded import sandbox
from tests.marking.sandbox.test_seccomp import CALL
from tests.patience import until

COURSE = Path(grader.__file__).parents[1]
CLOSED = "PermissionError: [Errno 13] Permission denied: "
DENIED = "PermissionError: [Errno 1] Operation not permitted"
BUILDER = ResourceLimits(programs=True)


def processes_of(user: int) -> list[str]:
    """The processes of a user that still run."""
    return [process for process, owner in owners().items() if owner == user]


def owners() -> dict[str, int]:
    """The users of all processes that run."""
    found = {}
    for place in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it may have ended
            lines = (place / "status").read_text().splitlines()
            about = dict(line.split(":\t", 1) for line in lines if ":\t" in line)
            if not about["State"].startswith("Z"):
                found[place.name] = int(about["Uid"].split()[0])
    return found


def files_of(user: int) -> list[str]:
    """The files of a user where every user may write."""
    return [
        entry.path
        for folder in separate_user.SHARED
        if os.path.isdir(folder)
        for entry in os.scandir(folder)
        if entry.stat(follow_symlinks=False).st_uid == user
    ]


def test_the_kind_is_named_and_each_process_is_a_user_without_groups(usual_sandbox, make_commanded):
    landlocked = " with Landlock" if landlock.version() else ""
    assert usual_sandbox.isolation == f"separate user{landlocked}"
    look = "import os; answer = [os.getresuid(), os.getresgid(), os.getgroups()]"
    users = [make_commanded(usual_sandbox).ask(look) for _ in range(2)]
    for users_ids, group_ids, groups in users:
        assert (len({*users_ids}), group_ids, groups) == (1, users_ids, [])
        assert users_ids[0] in separate_user.USERS
    assert users[0] != users[1]


def test_it_has_no_power_and_gains_none(commanded):
    lines = commanded.ask("answer = open('/proc/self/status').read().split('\\n')")
    status = dict(line.split(":\t") for line in lines if line)
    assert {status[name] for name in ("CapInh", "CapPrm", "CapEff", "CapAmb")} == {"0" * 16}
    assert (status["NoNewPrivs"], status["Seccomp"]) == ("1", "2")
    for attempt in ("os.setuid(0)", "os.setgroups([0])", "os.setresgid(0, 0, 0)", "os.chown('.', 0, 0)"):
        assert commanded.ask(f"import os; {attempt}").startswith(DENIED)


@pytest.mark.parametrize("path", ["/etc/shadow", "/proc/1/environ", "/proc/1/mem", "/proc/1/fd"])
def test_what_belongs_to_root_is_closed(commanded, path):
    attempt = f"os.listdir({path!r})" if path.endswith("fd") else f"open({path!r}, 'rb').read()"
    assert commanded.ask(f"import os; {attempt}").startswith("PermissionError: [Errno 13]")


@pytest.mark.skipif(not landlock.version(), reason="this kernel has no Landlock")
def test_files_that_everyone_may_read_are_closed_with_landlock(commanded, tmp_path):
    (tmp_path / "answers.txt").write_text("42")
    (tmp_path / "answers.txt").chmod(0o644)
    for path in (tmp_path / "answers.txt", "/etc/passwd", "/proc/1/cmdline", "/proc/meminfo",
                 COURSE / "pyproject.toml", COURSE / "solutions/02_topics/topics.ipynb"):  # fmt: skip
        assert commanded.ask(f"open({str(path)!r})") == f"{CLOSED}{str(path)!r}"
    for folder in ("/", "/proc", "/tmp", COURSE):
        assert commanded.ask(f"import os; os.listdir({str(folder)!r})") == f"{CLOSED}{str(folder)!r}"
    for path in ("/tmp/mine", "/var/tmp/mine", "/run/mine", sys.prefix + "/mine", "/etc/mine"):
        assert commanded.ask(f"open({path!r}, 'w')") == f"{CLOSED}{path!r}"


@pytest.mark.skipif(not landlock.version(), reason="this kernel has no Landlock")
def test_what_stays_with_the_judge_is_imported_before_and_closed(make_commanded):
    with sandbox(preload=["grader.geometry"], hidden=FOLDERS) as box:
        commanded = make_commanded(box)
        assert commanded.ask("from grader.geometry import Pose2D; answer = Pose2D.__name__") == "Pose2D"
        assert commanded.ask("import grader.course_files.notebook_format; answer = 'open'") == "open"
        for folder in FOLDERS:
            module = next(folder.rglob("__init__.py"))
            assert commanded.ask(f"open({str(module)!r})") == f"{CLOSED}{str(module)!r}"
        assert commanded.ask("import grader.exercises.safety").startswith("PermissionError: ")


def test_other_processes_are_out_of_reach(usual_sandbox, make_commanded):
    attacker, other = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    pids = [attacker.ask("import os; answer = os.getppid()"), other.process.pid, os.getpid(), 1]
    attacker.ask(CALL)
    for pid in pids:
        kill = f"import os, signal; os.kill({pid}, signal.SIGKILL)"
        assert attacker.ask(kill).startswith((DENIED, "ProcessLookupError"))
        assert attacker.ask(f"answer = call({seccomp.DENIED['ptrace']}, 16, {pid}, 0, 0)") == 1
        read = seccomp.DENIED["process_vm_readv"]
        assert attacker.ask(f"answer = call({read}, {pid}, 0, 0, 0, 0, 0)") == 1
        for name in ("mem", "environ", "maps", "fd/0", "root/etc/shadow"):
            answer = attacker.ask(f"open('/proc/{pid}/{name}', 'rb').read()")
            assert answer.startswith("PermissionError: [Errno 13]"), name
        assert attacker.ask(f"os.sched_setaffinity({pid}, [0])").startswith((DENIED, "Proc"))
        limit = f"import resource; resource.prlimit({pid}, resource.RLIMIT_CPU, (1, 1))"
        assert attacker.ask(limit).startswith(("PermissionError", "ProcessLookupError"))
    assert other.ask("answer = 'alive'") == "alive"


@pytest.mark.parametrize("target", ["-1", "0"])
def test_a_signal_to_everything_reaches_itself_alone(usual_sandbox, make_commanded, target):
    attacker, other = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    attacker.ask(f"import os, signal; os.kill({target}, signal.SIGKILL)")
    assert other.ask("answer = 'alive'") == "alive"
    assert make_commanded(usual_sandbox).ask("answer = 'alive'") == "alive"


@pytest.mark.parametrize(
    "attempt",
    [
        "import os; os.fork()",
        "import os; os.execv('/bin/true', ['true'])",
        "import socket; socket.socket()",
        "import socket; socket.socket(socket.AF_UNIX)",
        "import socket; socket.socket(type=socket.SOCK_DGRAM)",
        "import socket; socket.socket(socket.AF_NETLINK, socket.SOCK_RAW)",
        "import socket; socket.socketpair(type=socket.SOCK_DGRAM)",
        "import socket; a, b = socket.socketpair(); a.connect('/run/x')",
        "import os; os.memfd_create('x')",
        "import os; os.chroot('/')",
    ],
)
def test_programs_and_sockets_are_ordinary_errors(commanded, attempt):
    assert commanded.ask(attempt).startswith(DENIED)


def test_a_connected_pair_and_threads_are_allowed(commanded):
    pair = "import socket; a, b = socket.socketpair(); a.send(b'x'); answer = b.recv(1).decode()"
    assert commanded.ask(pair) == "x"
    work = "import threading; answer = []; t = threading.Thread(target=answer.append, args=(1,)); "
    assert commanded.ask(work + "t.start(); t.join()") == [1]


def test_no_other_finds_its_files_and_none_is_left(usual_sandbox, make_commanded):
    first, second = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    user, home = first.ask("import os; answer = [os.getuid(), os.getcwd()]")
    assert first.ask("answer = open('mine', 'w').write('!')") == 1
    assert first.ask("answer = open('/dev/shm/mine-of-test', 'w').write('!')") == 1
    assert second.ask(f"open({home!r} + '/mine')").startswith("PermissionError: [Errno 13]")
    assert second.ask("open('/dev/shm/mine-of-test')").startswith("PermissionError: [Errno 13]")
    assert files_of(user) == ["/dev/shm/mine-of-test"]
    first.leave()
    assert (os.path.exists(home), files_of(user), processes_of(user)) == (False, [], [])


def test_who_fills_the_disk_is_stopped(make_commanded):
    with sandbox(limits=ResourceLimits(scratch_mb=20)) as box:
        commanded = make_commanded(box)
        commanded.ask("import time; n = 0")
        commanded.tell("while True: open(str(n), 'wb').write(bytes(1 << 20)); n += 1; time.sleep(0.01)")
        end = commanded.ending()
    more = "The process wrote more than the 4096 files, or 20 MB, that are allowed."
    assert (end.kind, end.detail) == ("disk", more)


def test_who_makes_too_many_files_is_stopped(make_commanded):
    with sandbox(limits=ResourceLimits(scratch_files=100)) as box:
        commanded = make_commanded(box)
        commanded.ask("import time; n = 0")
        commanded.tell("while True: open(str(n), 'w').close(); n += 1; time.sleep(0.001)")
        assert commanded.ending().kind == "disk"


def daemon(place: str) -> str:
    """Code that starts a program which leaves its session, and notes that it runs."""
    program = f"import os, time; open({place!r}, 'w').close(); time.sleep(600)"
    return (
        "import subprocess, sys; answer = subprocess.Popen([sys.executable, '-c', "
        f"{program!r}], start_new_session=True, stdin=-3, stdout=-3, stderr=-3).pid"
    )


def test_the_programs_that_it_started_end_with_it(make_commanded):
    with sandbox(limits=BUILDER) as box:
        commanded = make_commanded(box)
        user = commanded.ask("import os; answer = os.getuid()")
        commanded.ask(daemon("started"))
        until(lambda: commanded.ask("answer = os.path.exists('started')"), "a program to start")
        assert len(processes_of(user)) == 2
        commanded.leave()
        until(lambda: processes_of(user) == [], "what it started to end with it")


def test_an_interpreter_that_it_starts_finds_all_that_a_build_imports(make_commanded):
    with sandbox(limits=BUILDER) as box:
        commanded = make_commanded(box)
        # If a .pth file names the course's folder, Landlock doesn't let it be listed; a build needs neither.
        paths = [file.read_text() for file in Path(sysconfig.get_path("purelib")).glob("*.pth")]
        hidden = {"sim", "grader"} if str(COURSE) in "\n".join(paths).splitlines() else set()
        needed = ", ".join(({*bubblewrap.PACKAGES} - hidden) | {"launch_process_starters", "build_tools"})
        command = [sys.executable, "-c", f"import {needed}"]
        options = f"cwd={str(TOOLS)!r}, stderr=subprocess.PIPE, text=True"
        assert commanded.ask(f"import subprocess; answer = subprocess.run({command}, {options}).stderr") == ""


def test_if_its_supervisor_is_killed_nothing_is_left_either(make_commanded):
    with sandbox(limits=BUILDER) as box:
        commanded = make_commanded(box)
        user, supervisor = commanded.ask("import os; answer = [os.getuid(), os.getppid()]")
        commanded.ask(daemon("started"))
        until(lambda: commanded.ask("answer = os.path.exists('started')"), "a program to start")
        os.kill(supervisor, signal.SIGKILL)
        until(lambda: len(processes_of(user)) == 1, "the process itself to end with its supervisor")
    until(lambda: processes_of(user) == [], "what it started to end with the sandbox")


def test_where_landlock_is_missing_what_must_be_closed_has_to_be_closed_by_its_mode():
    if landlock.version():
        pytest.skip("this kernel has Landlock")
    with tempfile.TemporaryDirectory(dir="/tmp") as place:  # pytest's own are in a closed one
        Path(place).chmod(0o755)
        assert separate_user.why_not([], [place]).startswith(
            "Separate users don't work either: this kernel has no Landlock, and other users can enter "
        )
        Path(place).chmod(0o700)
        assert separate_user.why_not([], [place]) == ""


def test_a_path_that_other_users_cannot_read_is_named(tmp_path):
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o700)
    assert separate_user.why_not([str(closed)], []) == (
        f"Separate users don't work either: other users can't read {closed}."
    )


def test_bubblewrap_does_not_work_here():
    bwrap = ["bwrap", "--ro-bind", "/", "/", "--unshare-user", "true"]
    assert subprocess.run(bwrap, capture_output=True, check=False).returncode != 0
    with pytest.raises(PermissionError):
        linux.unshare(linux.NEW_USER)


def test_no_port_of_this_machine_can_be_reached(commanded):
    with socket.create_server(("127.0.0.1", 0)) as server:
        target = server.getsockname()
        assert commanded.ask(f"import socket; socket.create_connection({target})").startswith(DENIED)
