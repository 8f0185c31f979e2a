"""Packages that are hostile, built in the sandbox: what each gets, and that nothing leaves it."""

import re
import socket

import pytest

from grader.marking.build_process import builder
from grader.marking.build_process.build_request import request_build
from grader.marking.sandbox import Sandbox
from sim.ros.remote import Wire
from tests.exercises.packages.greeter.students import RIGHT
from tests.patience import PATIENCE

FAILED = (
    r"colcon build (failed\.|ended unexpectedly\. "
    r"The process (needed|had) more than the .* that are allowed\.)"
)
SETUP = "greeter/setup.py"
ESCAPES = """
import ctypes, os, socket, subprocess, sys
libc, new_user, child = ctypes.CDLL(None), 0x10000000, 17
calls = {{"clone": (56, new_user | child, 0, 0, 0, 0), "unshare": (272, new_user), "ptrace": (101, 0)}}
said = [name for name, call in calls.items() if libc.syscall(*call) != -1]
for place in (sys.prefix, "/etc", "/usr", os.path.dirname(sys.argv[0]) or "/", {private!r}):
    try:
        open(os.path.join(place, "left"), "w").close()
        said.append(f"wrote {{place}}")
    except OSError:
        pass
try:
    said.append(open({private!r} + "/secret").read())
except OSError:
    pass
try:
    socket.create_connection(("192.0.2.1", 80), 0.1)
    said.append("a network")
except OSError as error:
    said += ["a network"] * ("timed out" in str(error))
quiet = {{"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}}
subprocess.Popen(["sleep", "1000"], start_new_session=True, **quiet)
print("SAID", said, file=sys.stderr, flush=True)
raise SystemExit("that was all")
"""


@pytest.fixture(scope="module")
def builders():
    with Sandbox(builder.ENTRY, builder.PRELOAD, limits=builder.LIMITS) as box:
        yield box


def built(box, **other):
    """What comes back, and how the process ended."""
    files = {path: text.encode() for path, text in RIGHT.items()}
    files |= {path.replace("__", "/").replace("_py", ".py"): text.encode() for path, text in other.items()}
    parent_end, child_end = socket.socketpair()
    process = box.start(child_end)
    try:
        return request_build(parent_end, files, lambda: process.wait(PATIENCE).detail)
    finally:
        process.kill()
        process.wait(PATIENCE)


def with_setup(box, text):
    return built(box, greeter__setup_py=f"{text}\n{RIGHT[SETUP]}")


def test_a_package_is_built(builders):
    made = built(builders)
    assert (made.problem, made.programs) == ("", {"lib/greeter/hello"})


def test_a_setup_that_reaches_out_reaches_nothing(builders, tmp_path):
    (tmp_path / "secret").write_text("a secret")
    made = with_setup(builders, ESCAPES.format(private=str(tmp_path)))
    assert made.problem == "colcon build failed."
    assert "SAID []" in made.output
    assert [path.name for path in tmp_path.iterdir()] == ["secret"]


def test_links_and_floods_in_what_is_installed_are_refused(builders):
    late = "import atexit, os\natexit.register(lambda: {})"
    install = "os.path.expanduser('~/ws/install/share')"
    link = with_setup(
        builders, late.format(f"os.path.isdir({install}) and os.symlink('/etc', {install} + '/x')")
    )
    assert link.problem.startswith("The installed files can't be used. `install/share/x` is a link.")
    flood = (
        f"[open({install} + f'/f{{n}}', 'w').close() for n in range(600)] if os.path.isdir({install}) else 0"
    )
    many = with_setup(builders, late.format(flood))
    assert many.problem == (
        "The installed files can't be used. install has more than 400 files. Leave out what isn't needed."
    )


@pytest.mark.parametrize(
    "setup",
    [
        "import os\nwhile True: os.fork()",
        *(
            pytest.param(text, marks=pytest.mark.soak)
            for text in (
                "held = [bytearray(1_000_000) for _ in range(5000)]",
                "open('large', 'wb').write(bytes(20_000_000))",
                "import os, signal\nos.kill(1, signal.SIGKILL)\nraise SystemExit('alive')",
            )
        ),
    ],
    ids=["forks", "memory", "large", "kills"],
)
def test_what_uses_too_much_fails_and_no_other_process_does(builders, setup):
    found = with_setup(builders, setup).problem
    assert re.fullmatch(FAILED, found)
    assert built(builders).problem == ""


@pytest.mark.parametrize("answer", [{}, {"files": 1}, {"files": {"a": 1}}, {"files": {"a": "text"}}])
def test_an_answer_that_makes_no_sense_is_no_build(answer):
    parent_end, child_end = socket.socketpair()
    with child_end:
        Wire(child_end).send(**answer)
        made = request_build(parent_end, {}, lambda: "")
    assert made.problem == "The installed files can't be used. install could not be read."


def test_files_that_lie_outside_are_refused():
    parent_end, child_end = socket.socketpair()
    with child_end:
        Wire(child_end).send(files={"../a": b""}, programs=[], output="", problem="")
        made = request_build(parent_end, {}, lambda: "")
    assert made.problem.startswith("The installed files can't be used. `install/../a`: a name may have")


def test_a_process_that_is_gone_is_reported_with_its_end():
    parent_end, child_end = socket.socketpair()
    child_end.close()
    problem = request_build(parent_end, {}, lambda: "It was killed.").problem
    assert problem == "colcon build ended unexpectedly. It was killed."
