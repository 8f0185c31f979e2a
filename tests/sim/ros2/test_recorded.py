"""%ros2 with a recording, compared with the official tools' output for the same nodes."""

import re

import pytest
from rclpy.qos import ReliabilityPolicy, qos_profile_sensor_data

from sim import run
from sim.ros.latest import latest
from sim.ros2.notebook import ros2
from tests.sim.ros2.nodes import NODES
from tests.sim.ros2.official import OFFICIAL, plain

CHANGES = re.compile(r"topic pub|service call|action send_goal|param (set|load|describe)|lifecycle [gs]et")
OVER = (
    "Nothing is running any more: this is the recording of the last run. Start one with play(...), and try "
    "again while it runs.\n"
)
# Where the course's output has more, or differs.
OWN = {
    "topic type /nothing": "Unknown topic '/nothing'\n",
    "service type /nothing": "Unknown service '/nothing'\n",
    "action type /nothing": "Unknown action '/nothing'\n",
    "interface package std_srvs": "std_srvs/srv/Empty\nstd_srvs/srv/SetBool\nstd_srvs/srv/Trigger\n",
    "interface package nothing_msgs": "Unknown package 'nothing_msgs'. Did you mean action_msgs?\n",
    "interface show std_msgs/msg/Nothing": (
        "Could not find the interface 'std_msgs/msg/Nothing'. Did you mean std_msgs/msg/String?\n"
    ),
}
MEASURED = {
    "topic hz /place": "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 49\n",
    "topic bw /place": (
        "Subscribed to [/place]\n449 B/s from 50 messages\n\tMessage size mean: 44 B min: 44 B max: 44 B\n"
    ),
    "topic delay /place": "average delay: 0.000\n\tmin: 0.000s max: 0.000s std dev: 0.00000s window: 50\n",
}
READ = [command for command in OFFICIAL if not CHANGES.match(command) and command not in MEASURED]


@pytest.fixture(scope="module")
def recording():
    return run(*NODES, seconds=5, quiet=True)


@pytest.fixture
def said(recording, capsys):
    """The output of a %ros2 command on the recording."""
    latest.recording = recording
    assert latest.player is None

    def said(line):
        ros2(line)
        out, err = capsys.readouterr()
        assert err == ""  # nbgrader takes it for a failure
        return out

    return said


@pytest.mark.parametrize("command", READ)
def test_a_recording_is_described_as_the_official_tools_describe_a_system(said, command):
    assert plain(said(command)) == OWN.get(command, plain(OFFICIAL[command]))


@pytest.mark.parametrize("command", MEASURED)
def test_statistics_of_a_recording_are_printed_at_once(said, command):
    assert said(command) == MEASURED[command]
    form = re.compile(r"-?[0-9.]+")
    lines = [form.sub("N", line) for line in OFFICIAL[command].splitlines()]
    assert {form.sub("N", line) for line in MEASURED[command].splitlines()} == set(lines)


@pytest.mark.parametrize(
    "command",
    [
        "topic pub --once /level std_msgs/msg/Float64",
        "service call /add example_interfaces/srv/AddTwoInts",
        "action send_goal /fibonacci example_interfaces/action/Fibonacci",
        "param set /talker speed 0.75",
        "param describe /talker speed",
        "lifecycle get",
        "lifecycle set /lamp configure",
    ],
)
def test_commands_that_need_running_nodes_are_refused(said, command):
    assert said(command) == OVER


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("topic info /plac", "Unknown topic '/plac'. Did you mean /place?\n"),
        (
            "topic hz /plac",
            "WARNING: topic [/plac] does not appear to be published yet. Did you mean /place?\n"
            "Could not determine the type for the passed topic\n",
        ),
        ("topic hz /level", "No message arrived on /level in this run.\n"),
        ("topic delay /greeting", "msg does not have header\n"),
        (
            "topic echo --once --qos-reliability reliable /place",
            "WARNING: /talker publishes /place with reliability best_effort, but this command requests "
            "reliable: no messages will be received from it\nNo message arrived on /place in this run.\n",
        ),
        ("topic echo --once --qos-durability volatile --field data /greeting", "hello\n---\n"),
        ("topic echo --once --filter m.x>1 --field point /place", "x: 1.5\ny: 0.0\nz: 0.0\n---\n"),
        ("topic hz --filter 1/0 /place", "--filter '1/0' fails: ZeroDivisionError: division by zero\n"),
        ("topic hz --filter m.point.x>99 /place", "No message arrived on /place in this run.\n"),
        ("topic echo --filter m.x>2 --field point /place", "No message arrived on /place in this run.\n"),
        ("topic echo --filter 1/0 /place", "--filter '1/0' fails: ZeroDivisionError: division by zero\n"),
        ("topic echo --once --raw /greeting", r"b'\x00\x01\x00\x00\x06\x00\x00\x00hello\x00'" "\n---\n"),
        ("topic echo --once -l 2 /greeting", "data: he...\n---\n"),
        ("topic echo /place std_msgs/msg/Nothing", "The message type 'std_msgs/msg/Nothing' is invalid\n"),
        ("service type /ad", "Unknown service '/ad'. Did you mean /add?\n"),
        (
            "action info /fibonaci",
            "Action: /fibonaci Did you mean /fibonacci?\nAction clients: 0\nAction servers: 0\n",
        ),
        ("param get /talker sped", "Parameter not set. Did you mean speed?\n"),
        ("param get /talkr speed", "Node not found. Did you mean /talker?\n"),
        ("node info /talkr", "Unable to find node '/talkr'. Did you mean /talker?\n"),
        ("lifecycle set /lmp configure", "Node not found. Did you mean /lamp?\n"),
        (
            "interface show Twist",
            "Invalid name 'Twist'. Expected three parts separated by '/'. "
            "Did you mean geometry_msgs/msg/Twist?\n",
        ),
        ("topic echo '/place", "\"topic echo '/place\" can't be read: No closing quotation.\n"),
        ("param list /talker --filter s", "  speed\n  start_type_description_service\n  steps\n"),
        ("param list /talker --param-prefixes gains", "  gains.p\n"),
        ("node list -a -c", "5\n"),
    ],
)
def test_missing_names_and_options(said, command, words):
    assert said(command) == words


@pytest.mark.parametrize(
    ("command", "end"),
    [
        (
            "tpic list",
            "ros2: error: argument COMMAND: there is no 'tpic', only action, bag, doctor, interface,"
            " launch, lifecycle, node, param, pkg, run, service, topic, wtf. Did you mean topic?\n",
        ),
        ("node list -x", "ros2: error: unrecognized arguments: -x\n"),
        ("topic hz", "ros2 topic hz: error: the following arguments are required: topic_name\n"),
        ("topic hz -w 0 /place", "error: argument -w/--window: value must be a positive integer\n"),
        ("topic pub -r no /a std_msgs/msg/Empty", "argument -r/--rate: Expects a floating point number\n"),
        ("topic pub -r 0 /a std_msgs/msg/Empty", "argument -r/--rate: Value must be positive\n"),
    ],
)
def test_invalid_arguments_get_a_suggestion(said, command, end):
    text = said(command)
    assert text.startswith("usage: ros2")
    assert text.endswith(end)


def test_help_lists_the_commands(said):
    assert said("").startswith("usage: ros2 [-h] COMMAND ...\n")
    assert "Print the average publishing rate to screen." in said("topic --help")


def test_qos_options_do_not_change_the_presets(said):
    said("topic echo --once --qos-reliability reliable --qos-depth 3 /place")
    assert qos_profile_sensor_data.reliability is ReliabilityPolicy.BEST_EFFORT
    assert qos_profile_sensor_data.depth == 5


def test_a_cell_prints_a_limited_number_of_messages(said):
    text = said("topic echo --field point.x /place")
    more = "... the first 10 messages; in Python, recording.messages('/place') has all\n"
    assert text == "1.5\n---\n" * 10 + more


def test_two_nodes_of_one_name_are_warned_of(said):
    latest.recording = run(NODES[0], NODES[0], seconds=1, quiet=True)
    warning = (
        "WARNING: Be aware that there are nodes in the graph that share an exact name, which can have"
        " unintended side effects.\n"
    )
    assert said("node list") == f"{warning}/talker\n/talker\n"
    assert said("node info /talker").startswith(
        'There are 2 nodes in the graph with the exact name "/talker". You are seeing information about only'
        " one of them.\n/talker\n"
    )


def test_doctor_reports_unmatched_topics_and_incompatible_qos(said):
    assert said("doctor") == (
        "UserWarning: Publisher without subscriber detected on /greeting.\n"
        "UserWarning: Publisher without subscriber detected on /lamp/transition_event.\n"
        "UserWarning: Subscriber without publisher detected on /level.\n"
        "UserWarning: Publisher without subscriber detected on /place.\n"
        "\nAll 3 checks passed\n\n"
    )
    assert said("doctor --include-warnings").endswith("\n1/3 check(s) failed\n\nFailed modules: topic\n")
    report = said("doctor --report")
    assert "\n   TOPIC LIST\ntopic               : /greeting\npublisher count     : 1\n" in report
    assert "compatibility status    : No publisher/subscriber pairs found\n" in report


def test_without_a_run_commands_are_refused(said):
    latest.recording = None
    assert said("node list") == (
        "Nothing has run yet: start nodes with run(...) or play(...), and then inspect them.\n"
    )
