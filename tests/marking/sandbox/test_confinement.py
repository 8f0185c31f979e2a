"""Ways out of the sandbox, each tried from inside."""
import json
import os
import shutil
import socket
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import grader
from grader.marking.sandbox import bubblewrap
from grader.marking.student_process.judge_only import FOLDERS
from tests.marking.sandbox.commanded import sandbox

COURSE = Path(grader.__file__).parents[1]
ABSTRACT = f"\0marking-test-{os.getpid()}"


def test_of_the_course_only_its_packages_are_there(commanded):
    allowed = {"grader", "ros_packages", "sim", "tests"}  # tests/ for the entry of these tests
    if Path(sys.prefix).parent == COURSE:
        allowed.add(Path(sys.prefix).name)
    assert set(commanded.ask(f"import os; answer = os.listdir({str(COURSE)!r})")) == allowed
    there = commanded.ask(f"import os; answer = os.listdir({str(COURSE / 'ros_packages/python')!r})")
    python = COURSE / "ros_packages/python"
    packages = {file.parent.name for file in python.glob("*/__init__.py")}
    files = {*there} - {"__pycache__", "pyproject.toml"}
    assert files == packages | {file.name for file in python.glob("*.py")}
    assert commanded.ask(f"answer = os.listdir({str(COURSE / 'tests')!r})") == ["marking"]


@pytest.mark.parametrize(
    "place", [".secret", "class/gradebook.db", "class/submitted", "solutions", "nbgrader_config.py", ".git"]
)
def test_nothing_of_the_instructor_can_be_opened(commanded, place):
    path = str(COURSE / place)
    answer = commanded.ask(f"open({path!r})")
    assert answer == f"FileNotFoundError: [Errno 2] No such file or directory: {path!r}"


def test_the_home_of_the_marker_holds_python_at_most(commanded):
    home = Path.home()
    seen = commanded.ask(f"import glob; answer = glob.glob('{home}/*', include_hidden=True)")
    shown = [Path(path) for path in (sys.base_prefix, sys.prefix, COURSE)]
    assert [name for name in seen if not any(path.is_relative_to(name) for path in shown)] == []


def test_files_of_the_host_are_not_there(commanded, tmp_path):
    (tmp_path / "answers.txt").write_text("42")
    assert commanded.ask(f"open({str(tmp_path / 'answers.txt')!r})").startswith("FileNotFoundError: ")
    assert commanded.ask("import os; answer = os.path.exists('/etc/passwd')") is False


def test_what_is_readable_can_be_read_and_not_changed_even_in_tmp(tmp_path, make_commanded):
    data = tmp_path / "release" / "data.csv"
    data.parent.mkdir()
    data.write_text("1,2")
    with sandbox(readable=[data, tmp_path / "release"]) as box:
        commanded = make_commanded(box)
        assert commanded.ask(f"answer = open({str(data)!r}).read()") == "1,2"
        answer = commanded.ask(f"open('{data}', 'w')")
        assert answer == f"OSError: [Errno 30] Read-only file system: '{data}'"
        assert commanded.ask(f"import os; os.rename({str(data)!r}, '/tmp/x')").startswith("OSError: ")
        assert commanded.ask("answer = open('/tmp/mine', 'w').write('!')") == 1
        commanded.leave()
    assert data.read_text() == "1,2"


def test_what_stays_with_the_judge_is_imported_before_and_has_no_file(make_commanded):
    with sandbox(preload=["grader.geometry"], hidden=FOLDERS) as box:
        commanded = make_commanded(box)
        assert commanded.ask("from grader.geometry import Pose2D; answer = Pose2D.__name__") == "Pose2D"
        for folder in FOLDERS:
            assert commanded.ask(f"import os; answer = os.listdir({str(folder)!r})") == []
        closed = commanded.ask("import grader.exercises.safety.mutants.workshop")
        assert closed.startswith("ModuleNotFoundError: ")
        assert "checks" in commanded.ask(f"import os; answer = os.listdir({str(COURSE / 'grader')!r})")


def test_the_course_itself_may_lie_in_tmp(tmp_path):
    for package in ("grader", "sim", "ros_packages/interfaces/build_tools"):
        shutil.copytree(COURSE / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    attempt = f"""
        import sys
        sys.path += [{str(COURSE)!r}]
        from tests.marking.sandbox.commanded import Commanded, sandbox
        with sandbox() as box:
            commanded = Commanded(box)
            print(commanded.ask("import grader.typos; answer = grader.typos.__file__"))
            commanded.leave()
    """
    command = [sys.executable, "-c", textwrap.dedent(attempt)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == f"{tmp_path}/grader/typos.py\n", done.stderr


def test_python_may_be_called_by_links_from_anywhere(tmp_path):
    """As a virtual environment is, that was made with a Python of ~/.local/bin."""
    python = os.path.realpath(sys.executable)
    folders = [tmp_path / name for name in ("environment", "elsewhere", "farther")]
    for folder in folders:
        folder.mkdir()
    environment, elsewhere, farther = folders
    (elsewhere / "folder").symlink_to(farther)
    (environment / "python").symlink_to("python3")
    (environment / "python3").symlink_to(elsewhere / "folder/python3")
    (farther / "python3").symlink_to("../farther/other")
    (farther / "other").symlink_to(python)
    program = [str(environment / "python"), "-c", "import json, sys; print(sys.executable)"]
    command = bubblewrap.command([*bubblewrap.visible_paths([]), str(environment)], [], program)
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.stdout == f"{environment}/python\n", done.stderr


@pytest.mark.parametrize(
    "folder", [sys.prefix, sys.base_prefix, str(COURSE / "grader"), "/usr/lib", "/", "/etc", "/dev"]
)
def test_nothing_but_its_own_places_can_be_written(commanded, folder):
    answer = commanded.ask(f"open({folder!r} + '/mine', 'w')")
    assert answer == f"OSError: [Errno 30] Read-only file system: '{folder}/mine'"


@pytest.mark.parametrize("path", ["/", "/usr", "/dev", "/dev/full", "/dev/null", "/proc/self", sys.prefix])
def test_no_mode_outside_its_own_places_can_be_changed(commanded, path):
    before = os.stat(path).st_mode
    answer = commanded.ask(f"import os; os.chmod({path!r}, os.stat({path!r}).st_mode)")  # no harm
    assert answer in (
        f"OSError: [Errno 30] Read-only file system: {path!r}",
        f"PermissionError: [Errno 1] Operation not permitted: {path!r}",
    )
    assert os.stat(path).st_mode == before


def test_the_devices_that_programs_need_are_there(commanded):
    assert commanded.ask("answer = open('/dev/null', 'w').write('gone')") == 4
    assert commanded.ask("answer = len(open('/dev/urandom', 'rb').read(8))") == 8
    assert commanded.ask("import os; os.fchmod(0, 0o666)") == "OSError: [Errno 30] Read-only file system"


@pytest.mark.parametrize("folder", ["/tmp", "/dev/shm", "/student"])
def test_what_one_leaves_behind_no_other_finds(usual_sandbox, make_commanded, folder):
    first, second = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    assert first.ask(f"answer = open({folder!r} + '/mine', 'w').write('!')") == 1
    look = f"import os; answer = sorted(os.listdir({folder!r}))"
    always = second.ask(look)  # the path to the course, if that is in /tmp
    assert "mine" not in always
    assert first.ask(look) == sorted([*always, "mine"])
    first.leave()
    assert make_commanded(usual_sandbox).ask(look) == always


def test_the_environment_holds_nothing_of_the_markers(monkeypatch, make_commanded):
    monkeypatch.setenv("COURSE_SECRET", "do not tell")
    with sandbox() as box:
        commanded = make_commanded(box)
        assert "COURSE_SECRET" not in commanded.ask("import os; answer = dict(os.environ)")
        assert "do not tell" not in commanded.ask("answer = open('/proc/self/environ').read()")
        commanded.leave()


def test_it_has_its_wire_and_no_other_descriptor(commanded):
    links = "import os; answer = [os.readlink(f'/proc/self/fd/{n}') for n in range(4)]"
    stdin, stdout, _, wire = commanded.ask(links)
    assert (stdin, stdout, wire[:8]) == ("/dev/null", "/dev/null", "socket:[")
    assert commanded.ask("os.fstat(4)") == "OSError: [Errno 9] Bad file descriptor"
    assert commanded.ask("answer = len(os.listdir('/proc/self/fd'))") == 4 + 1  # one for the look itself


def test_it_sees_no_process_but_itself(usual_sandbox, make_commanded):
    first, second = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    look = "import os; answer = [os.getpid(), os.getppid(), os.listdir('/proc')]"
    assert first.ask(look) == second.ask(look) == [1, 0, ["self"]]
    assert first.ask("answer = open('/proc/2/environ')").startswith("FileNotFoundError: ")


@pytest.mark.parametrize("target", ["0", "-1", "1", "2", "-2"])
def test_it_can_kill_no_other_process(usual_sandbox, make_commanded, target):
    attacker, other = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    attacker.ask(f"import os, signal; os.kill({target}, signal.SIGKILL)")
    assert other.ask("answer = 'alive'") == "alive"
    assert make_commanded(usual_sandbox).ask("answer = 'alive'") == "alive"


@pytest.mark.parametrize(
    "attempt",
    [
        "import os; os.fork()",
        "import os; os.execv('/bin/true', ['true'])",
        "import os; os.posix_spawn('/bin/true', ['true'], {})",
        "import subprocess; subprocess.run(['true'])",
        "import multiprocessing; multiprocessing.get_context('fork').Process().start()",
        "import socket; socket.socket(40, socket.SOCK_STREAM)",  # to the host of a virtual machine
        "import socket; socket.socket(socket.AF_INET6)",
        "import os; os.mkfifo('x')",
        "import os; os.memfd_create('x')",
        "import os; os.pidfd_open(1)",
        "import os; os.chroot('/tmp')",
    ],
)
def test_new_processes_and_the_like_are_ordinary_errors(commanded, attempt):
    assert commanded.ask(attempt).startswith("PermissionError: [Errno 1] Operation not permitted")


def test_threads_are_allowed(commanded):
    work = "import threading; answer = []; t = threading.Thread(target=answer.append, args=(1,)); "
    assert commanded.ask(work + "t.start(); t.join()") == [1]


UNREACHABLE = "OSError: [Errno 101] Network is unreachable"


@pytest.mark.parametrize("address", ["1.1.1.1", "127.0.0.1", "169.254.169.254"])
def test_no_address_can_be_reached(commanded, address):
    with socket.create_server(("127.0.0.1", 0)) as server:
        target = (address, server.getsockname()[1])
        assert commanded.ask(f"import socket; socket.create_connection({target})") == UNREACHABLE
        assert commanded.ask(f"socket.socket(type=socket.SOCK_DGRAM).sendto(b'x', {target})") == UNREACHABLE


def test_no_name_can_be_looked_up(commanded):
    assert commanded.ask("import socket; socket.getaddrinfo('example.org', 80)").startswith("gaierror: ")


def test_abstract_sockets_lead_nowhere(usual_sandbox, make_commanded):
    first, second = make_commanded(usual_sandbox), make_commanded(usual_sandbox)
    name = json.dumps(ABSTRACT)
    attempt = f"import socket; s = socket.socket(socket.AF_UNIX); s.connect({name})"
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(ABSTRACT)
        server.listen()
        assert first.ask(attempt) == "ConnectionRefusedError: [Errno 111] Connection refused"
    serve = f"s = socket.socket(socket.AF_UNIX); s.bind({name}); s.listen(); answer = 'open'"
    assert first.ask(serve) == "open"
    assert second.ask(attempt) == "ConnectionRefusedError: [Errno 111] Connection refused"


def test_ports_of_one_are_free_for_the_next(usual_sandbox, make_commanded):
    bind = "import socket; s = socket.socket(type=socket.SOCK_DGRAM); s.bind(('', 7410)); answer = 'bound'"
    assert [make_commanded(usual_sandbox).ask(bind) for _ in range(2)] == ["bound", "bound"]


@pytest.mark.parametrize("file", ["oom_score_adj", "autogroup", "timerslack_ns", "uid_map", "mem"])
def test_it_can_t_change_how_the_kernel_treats_it(commanded, file):
    answer = commanded.ask(f"open('/proc/self/{file}', 'w')")
    assert answer == f"OSError: [Errno 30] Read-only file system: '/proc/self/{file}'"


def test_where_memory_runs_out_it_goes_first(commanded):
    assert commanded.ask("answer = int(open('/proc/self/oom_score_adj').read())") == 1000


def test_its_own_user_has_no_power(commanded):
    lines = commanded.ask("answer = open('/proc/self/status').read().split('\\n')")
    status = dict(line.split(":\t") for line in lines if line)
    assert {status[name] for name in ("CapInh", "CapPrm", "CapEff", "CapAmb")} == {"0" * 16}
    assert (status["NoNewPrivs"], status["Seccomp"]) == ("1", "2")
