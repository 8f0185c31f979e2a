"""ros2 in a terminal: nodes in another process, in real time."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from sim.ros2.terminal import IN_CELL, official_command
from tests.patience import PATIENCE, until
from tests.sim.ros2.official import OFFICIAL, plain
from tests.sim.ros2.test_played import OWN as PLAYED
from tests.sim.ros2.test_played import PARAMETERS
from tests.sim.ros2.test_recorded import MEASURED
from tests.sim.ros2.test_recorded import OWN as READ
from tests.sim.standalone.programs import REPOSITORY, environment, free_domain, robot

OWN = READ | PLAYED
FAILS = re.compile(
    r"absent|[Nn]othing|dat:|c: 3|hello$|9\.0|label ''|fixed false|speed fast|activate|lifecycle get /talker"
)
NOT_YET = re.compile(r"WARNING: topic \[.*\] does not appear to be published yet")  # on a busy machine
ROS2 = [sys.executable, "-m", "sim.ros2.terminal"]


def start(words, domain, **more):
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    reported = environment(ROS_DOMAIN_ID=str(domain), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", **more)
    process = subprocess.Popen(words, cwd=REPOSITORY, text=True, env=reported, **pipes)
    process.domain = domain  # which is another test's again when the process is gone
    return process


def ended(words, domain, **more):
    """Status, stdout and stderr of a program that was run to its end."""
    process = start(words, domain, **more)
    out, err = process.communicate(timeout=PATIENCE)
    return process.returncode, out, err


@pytest.fixture(scope="module")
def system():
    """The nodes in a process of their own; the domain."""
    domain = free_domain()
    process = start([sys.executable, "-m", "tests.sim.ros2.nodes"], domain)
    domain.endpoints = process.stdout.readline().strip()
    assert domain.endpoints
    yield domain
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=PATIENCE)


@pytest.fixture(scope="module")
def terminal(system, tmp_path_factory):
    """Executes commands in another process; returns their output and status."""
    file = tmp_path_factory.mktemp("parameters") / "params.yaml"
    file.write_text(PARAMETERS)
    process = start([sys.executable, "-m", "tests.sim.ros2.client", system.endpoints], system)

    def say(line):
        words = [str(file) if word == file.name else word for word in shlex.split(line)]
        process.stdin.write(json.dumps(words) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
        return "".join(f"{text}\n" for text in answer["output"] + answer["errors"]), answer["status"]

    yield say
    process.communicate(timeout=PATIENCE)


@pytest.mark.parametrize("command", [command for command in OFFICIAL if command not in MEASURED])
def test_nodes_in_another_process_are_described_as_by_the_official_tools(terminal, command):
    said, status = terminal(command)
    expected = plain(OWN.get(command, OFFICIAL[command]))
    if "--feedback" in command:  # a topic: it may overtake the acceptance, and the result it
        said, wanted = Counter(plain(said).split("\n\n")), Counter(expected.split("\n\n"))
        assert not said - wanted
        assert all(block.startswith("Feedback:") for block in wanted - said)
    else:
        assert plain(said) == expected
    assert status == (1 if FAILS.search(command) else 0)


@pytest.mark.parametrize("command", MEASURED)
def test_statistics_are_printed_until_ctrl_c(system, command):
    process = start([*ROS2, *command.split()], system)
    lines = [line for line in (process.stdout.readline() for _ in range(5)) if not NOT_YET.match(line)][:4]
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=PATIENCE)[1] == ""
    assert process.returncode == 2
    form = re.compile(r"-?[0-9.]+( K?B)?")
    known = {form.sub("N", line) for line in OFFICIAL[command].splitlines(keepends=True)}
    assert {form.sub("N", line) for line in lines} <= known


def test_ctrl_c_in_a_destructor_is_not_lost():
    program = """
import signal, time
from sim.ros2 import terminal

class Going:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

def execute(*_):
    Going()
    while True:
        time.sleep(0.1)

terminal.parser.execute = execute
raise SystemExit(terminal.main())
"""
    assert ended([sys.executable, "-c", program, "topic", "list"], free_domain()) == (2, "", "")


def test_errors_are_printed_on_stderr(system):
    said = until(lambda: answer_of_who_found_it(["param", "get", "/talkr", "speed"], system))
    assert said == (1, "", "Node not found. Did you mean /talker?\n")
    status, out, err = ended([*ROS2, "tpic", "list"], system)
    assert (status, out) == (2, "")
    assert err.endswith("Did you mean topic?\n")


def answer_of_who_found_it(arguments, domain):
    """As `ended`; None where nothing was discovered yet, as on a busy machine."""
    said = ended([*ROS2, *arguments], domain)
    return said if said[2] != "Node not found\n" else None


def test_doctor_checks_the_same_as_in_a_recording(terminal):
    until(lambda: "Subscription count: 0" in terminal("topic info /place")[0])  # others have left
    assert terminal("doctor") == (
        "UserWarning: Publisher without subscriber detected on /greeting.\n"
        "UserWarning: Publisher without subscriber detected on /lamp/transition_event.\n"
        "UserWarning: Subscriber without publisher detected on /level.\n"
        "UserWarning: Publisher without subscriber detected on /place.\n"
        "\nAll 3 checks passed\n\n",
        0,
    )


def test_a_bag_is_recorded_until_ctrl_c_and_played_back(terminal, system, tmp_path):
    folder = tmp_path / "kept"
    process = start([*ROS2, "bag", "record", "-o", str(folder), "/place"], system)
    while "Subscribed" not in process.stdout.readline():
        assert process.poll() is None
    while "Subscription count: 1" not in terminal("topic info /place")[0]:
        assert process.poll() is None
    for _ in range(3):  # meanwhile some come
        terminal("topic echo --once /place")
    process.send_signal(signal.SIGINT)
    last = process.communicate(timeout=PATIENCE)[0].splitlines(keepends=True)[-1]
    count = int(re.fullmatch(rf"Recording stopped: (\d+) messages in {folder}\n", last)[1])
    row = f"Topic: /place | Type: geometry_msgs/msg/PointStamped | Count: {count} | Serialization"
    assert row in terminal(f"bag info {folder}")[0]
    said, status = terminal(f"bag play -r 100 {folder}")
    begin, end = said.splitlines()
    assert re.fullmatch(rf"Playing {count} messages on /place: \d\.\d s", begin)
    assert end == f"Played {count} messages from {folder}"
    assert status == 0


def test_a_topic_of_the_robot_is_measured_beside_it():
    with robot("--headless") as running:
        process = start([*ROS2, "topic", "hz", "/scan"], running.domain)
        first = next(line for line in iter(process.stdout.readline, "") if not NOT_YET.match(line))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
    assert re.fullmatch(r"average rate: \d+\.\d{3}\n", first)


def test_a_domain_without_nodes_gets_a_hint_at_others(system):
    elsewhere = free_domain()
    status, out, err = ended([*ROS2, "node", "list"], elsewhere)
    assert (status, out) == (0, "")
    assert err.startswith(f"There are no nodes on ROS domain {elsewhere} of this machine, but on ")
    assert str(system) in err


def test_a_command_in_a_cell_points_to_the_magic(system, monkeypatch):
    monkeypatch.setenv("JPY_PARENT_PID", "1")
    status, out, err = ended([*ROS2, "topic", "list"], system)
    assert (status, err) == (0, f"{IN_CELL}\n")
    assert "/parameter_events" in out


def test_an_invalid_domain_is_reported():
    wrong = "ROS_DOMAIN_ID is 'lab', but a domain is a whole number from 0 to 232: export ROS_DOMAIN_ID=42\n"
    assert ended([*ROS2, "node", "list"], "lab") == (1, "", wrong)


# What bash does when Tab is pressed after a line; prints the completions.
TAB = """
eval "$(register-python-argcomplete ros2)"
while read -r COMP_LINE; do
    COMP_LINE=${COMP_LINE%.} COMP_POINT=${#COMP_LINE} COMP_TYPE=9 COMPREPLY=()
    _python_argcomplete ros2 "" ""
    echo "${COMPREPLY[*]}"
done
"""
TYPED = {
    "ros2 topic e": "echo",
    "ros2 topic hz /pl": "/place",
    "ros2 topic pub /place ": "geometry_msgs/msg/PointStamped",
    "ros2 service call /add ": "example_interfaces/srv/AddTwoInts",
    "ros2 action send_goal /fibonacci ": "example_interfaces/action/Fibonacci",
    "ros2 lifecycle get /": "/lamp",
    "ros2 param get /talker s": "speed start_type_description_service steps",
    "ros2 param get /absent s": "",
    "ros2 run turtlesim ": "mimic turtlesim_node",
    "ros2 run nowhere ": "",
}


def test_bash_completes_verbs_names_and_types(system):
    """On a busy machine a completion may be empty, and is requested again."""
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    shell = start(["bash", "-c", TAB], system, PATH=path)

    def offered(line):
        shell.stdin.write(f"{line}.\n")  # the dot, for read drops spaces at the end
        shell.stdin.flush()
        return " ".join(shell.stdout.readline().split())

    for line, expected in TYPED.items():
        found = until(lambda line=line: offered(line), line) if expected else offered(line)
        assert (line, found) == (line, expected)
    assert shell.communicate(timeout=PATIENCE)[1] == ""


def test_an_invalid_domain_completes_nothing():
    """Bash would show an error in the middle of the line."""
    reported = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": " ", "_ARGCOMPLETE_STDOUT_FILENAME": "/dev/stderr"}
    reported |= {"_ARGCOMPLETE_SHELL": "bash", "COMP_TYPE": "9", "COMP_POINT": "16"}
    reported |= {"COMP_LINE": "ros2 node info /"}
    program = "import sys; from sim.ros2.terminal import main; sys.exit(main())"
    assert ended([sys.executable, "-c", program], "lab", **reported) == (0, "", "")


def test_the_official_command_is_executed_if_installed(tmp_path):
    own, other = tmp_path / "own", tmp_path / "other"
    texts = {own: "from sim.ros2.terminal import main", other: 'echo official "$@"; exit 3'}
    for folder, text in texts.items():
        folder.mkdir()
        (folder / "ros2").write_text(f"#!/bin/sh\n{text}\n")
        (folder / "ros2").chmod(0o755)
    assert official_command(str(own)) is None
    assert official_command(f"{own}:{tmp_path / 'none'}::{other}") == other / "ros2"
    path = f"{own}:{other}:{os.environ['PATH']}"
    assert ended([*ROS2, "topic", "list"], 0, PATH=path) == (3, "official topic list\n", "")


def test_ctrl_c_in_a_constructor_prints_nothing(system):
    program = """
import signal, sys
from sim.ros2 import parser, terminal

class HalfMade:
    def __init__(self):
        signal.raise_signal(signal.SIGINT)
        self.made = True

    def __del__(self):
        assert self.made

parser.execute = lambda *_: HalfMade()
sys.exit(terminal.main())
"""
    assert ended([sys.executable, "-c", program], system) == (2, "", "")


# Ctrl-C at the import of a module, in the middle of discovery, while it echoes, and as Python ends.
MOMENTS = {
    "import": """
class Interrupts:
    def find_spec(self, name, path=None, target=None):
        if name == {where!r}:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupts())
""",
    "call": """
import importlib
module, _, name = {where!r}.rpartition(":")
owner = importlib.import_module(module)
*path, name = name.split(".")
for part in path:
    owner = getattr(owner, part)
original = getattr(owner, name)

def interrupted(*arguments, **keywords):
    signal.raise_signal(signal.SIGINT)
    return original(*arguments, **keywords)

setattr(owner, name, interrupted)
""",
}
COMMAND = """
import signal, sys
sys.argv = ["ros2", *{words!r}]
{moment}
from sim.ros2.terminal import main
status = main()
{end}
sys.exit(status)
"""


def interrupted_at(moment, where, words, domain, end=""):
    code = COMMAND.format(words=words.split(), moment=MOMENTS[moment].format(where=where), end=end)
    return ended([sys.executable, "-c", code], domain)


IMPORTED = ["rclpy", "sim.ros2.verbs.echo", "numpy"]
CALLED = [
    "sim.ros2.live:rclpy.create_node",
    "sim.ros2.live:LiveSystem.wait_for_graph",
    "sim.ros2.verbs.echo:_format",
    "sim.ros2.live:LiveSystem.__exit__",
]


@pytest.mark.parametrize("module", IMPORTED)
def test_ctrl_c_is_quiet_while_a_command_imports(system, module):
    status, _, err = interrupted_at("import", module, "topic echo /place --once", system)
    assert (status in (2, -signal.SIGINT), err) == (True, "")


@pytest.mark.parametrize("function", CALLED)
def test_ctrl_c_is_quiet_at_any_moment_of_a_command(system, function):
    # With the type, so that the command waits for the robot however late it finds it.
    words = "topic echo /place geometry_msgs/msg/PointStamped --once"
    status, _, err = interrupted_at("call", function, words, system)
    assert (status, err) == (2, "")


def test_ctrl_c_is_quiet_when_a_command_has_ended():
    end = "signal.raise_signal(signal.SIGINT)"
    assert interrupted_at("import", "nothing", "pkg prefix sim", free_domain(), end)[0::2] == (
        -signal.SIGINT, "Package not found\n",
    )  # fmt: skip


def test_ctrl_c_is_quiet_while_a_command_echoes(system):
    # With the type, so that the command waits for the robot however late it finds it.
    process = start([*ROS2, "topic", "echo", "/place", "geometry_msgs/msg/PointStamped"], system)
    line = next(line for line in iter(process.stdout.readline, "") if not NOT_YET.match(line))
    process.send_signal(signal.SIGINT)
    assert (line, process.communicate(timeout=PATIENCE)[1], process.returncode) == ("header:\n", "", 2)
