"""%ros2 with a running player, in simulated time."""

import math
from pathlib import Path
from time import perf_counter

import pytest
from rclpy.node import Node

from sim.ros.bags.bag_files import Bag
from sim.ros.latest import latest
from sim.ros.messages.decoder import decode
from sim.ros2.notebook import ros2
from tests.sim.ros.playing import player
from tests.sim.ros2.nodes import NODES
from tests.sim.ros2.official import OFFICIAL, plain
from tests.sim.ros2.test_recorded import CHANGES

UNMATCHED = (
    "Waiting for at least 1 matching subscription(s)... No node subscribes to /levle. Did you mean /level?\n"
)
PARAMETERS = "/talker:\n  ros__parameters:\n    speed: 1.25\n    label: ''\n"
# The nearest name is the course's; a failed transition's or goal's form is official.
OWN = {
    "topic pub --once /level std_msgs/msg/Nothing '{data: 2.0}'": (
        "The passed message type is invalid. Did you mean std_msgs/msg/String?\n"
    ),
    "service call /add example_interfaces/srv/Nothing '{a: 2}'": (
        "The passed service type is invalid. Did you mean example_interfaces/srv/Trigger?\n"
    ),
}


@pytest.fixture
def playing(capsys, tmp_path, monkeypatch):
    """A player of the nodes, as fast as possible; returns the output of a %ros2 command."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "params.yaml").write_text(PARAMETERS)
    made = player(*NODES, seconds=200, speed=math.inf, clock=perf_counter)

    def said(line):
        ros2(line)
        out, err = capsys.readouterr()
        assert err == ""
        return out

    said.player = made
    yield said
    made.stop()


def test_echo_says_which_qos_does_not_match(playing):
    assert playing("topic echo --qos-durability transient_local /place") == (
        "WARNING: /talker publishes /place with durability volatile, but this command requests "
        "transient_local: no messages will be received from it\n"
        "No message arrived on /place within 5 s of the play.\n"
    )


def test_commands_that_change_the_system_match_the_official_tools(playing):
    for command in filter(CHANGES.match, OFFICIAL):
        expected = plain(OFFICIAL[command])
        assert plain(playing(command)) == OWN.get(command, expected), command
    levels = [received.message.data for received in playing.player.recording.messages("/level")]
    assert levels == [2.0, 2.0, 2.0]
    assert not playing.player.recording.errors


def test_its_own_node_is_not_listed(playing):
    playing("param get /talker speed")
    assert playing("node list -a") == OFFICIAL["node list"]
    assert plain(playing("topic list -v")) == plain(OFFICIAL["topic list -v"])
    assert playing.player.recording.is_course_node("/_ros2cli_1") or any(
        name.startswith("/_ros2cli") for name in playing.player.recording.course_nodes
    )


def test_it_measures_for_five_simulated_seconds_and_reports_every_second(playing):
    before = playing.player.recording.stamp
    lines = playing("topic hz /place").splitlines()
    assert lines[::2] == ["average rate: 10.000"] * 4
    assert [line.rsplit(" ", 1)[1] for line in lines[1::2]] == ["10", "20", "30", "40"]
    assert playing.player.recording.stamp == pytest.approx(before + 5.0)


def test_no_more_time_passes_than_a_response_takes(playing):
    call = "service call /add example_interfaces/srv/AddTwoInts '{a: 2, b: 3}'"
    assert playing(call).endswith("sum=5)\n\n")
    assert playing.player.recording.stamp < 0.5


def test_endless_publishing_ends_after_five_simulated_seconds(playing):
    assert playing("topic pub -r 2 -p 5 /level std_msgs/msg/Float64 '{data: 1.0}'") == (
        "publisher: beginning loop\n"
        "publishing #5: std_msgs.msg.Float64(data=1.0)\n\npublishing #10: std_msgs.msg.Float64(data=1.0)\n\n"
    )
    assert len(playing.player.recording.messages("/level")) == 10


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (
            "topic pub --once /levle std_msgs/msg/Float64",
            UNMATCHED
            + 2 * "Waiting for at least 1 matching subscription(s)...\n"
            + "Nothing came of it within 2.1 s of the play.\n",
        ),
        (
            "topic pub --once --max-wait-time-secs 0.3 /levle std_msgs/msg/Float64",
            f"{UNMATCHED}Timed out waiting for subscribers: Expected 1 subcribers but only got 0 "
            "subscribers\n",
        ),
        (
            "service call /ad example_interfaces/srv/AddTwoInts",
            "waiting for service to become available... Did you mean /add?\n"
            "Nothing came of it within 20 s of the play.\n",
        ),
        (
            "action send_goal /fib example_interfaces/action/Fibonacci",
            "Waiting for an action server to become available...\n"
            "Nothing came of it within 20 s of the play.\n",
        ),
        ("topic hz /level", "No message arrived on /level within 5 s of the play.\n"),
        (
            "topic pub /level std_msgs/msg/Float64 '{data: [1}'",
            "'{data: [1}' is not YAML, such as '{x: 1.0, y: 2.0}': while parsing a flow sequence\n",
        ),
        (
            "topic pub '/a b' std_msgs/msg/Empty",
            "Invalid topic name: topic name must not contain characters other than alphanumerics, ",
        ),
        ("param load /talker none.yaml", "none.yaml can't be read: No such file or directory\n"),
        ("bag play none", "Bag path 'none' is not there.\n"),
        (
            "bag record",
            "Need to specify at least one option out of --all, --all-topics, --all-services, --services, "
            "--topics, --topic-types or --regex\n",
        ),
        (
            "bag play none --clock",
            "`--clock` is for a terminal: here all clocks show the simulated time of the play.\n",
        ),
        (
            "doctor hello",
            "`ros2 doctor hello` communicates with other machines: type it in a terminal of each.\n",
        ),
    ],
)
def test_a_failure_is_explained(playing, command, words):
    assert playing(command).startswith(words)


def test_a_paused_player_refuses_commands(playing):
    playing.player.play_frame(0.5)
    playing.player.pause()
    still = "The play is paused, so nothing happens in it: resume it, and try again.\n"
    assert playing("topic hz /place") == still
    assert playing("param get /talker speed") == still
    assert playing("node list") == OFFICIAL["node list"]


def test_ctrl_c_ends_an_endless_command(playing):
    player, turn, turns = playing.player, playing.player.play_frame, []

    def interrupted(*arguments):
        turns.append(turn(*arguments))
        if len(turns) == 3:
            raise KeyboardInterrupt

    player.play_frame, player.speed = interrupted, 20.0
    assert playing("topic pub -r 100 -p 0 /level std_msgs/msg/Float64").endswith("Stopped.\n")
    player.play_frame, player.speed = turn, math.inf
    turn(player.recording.stamp + 0.2)
    count = len(player.recording.messages("/level"))
    turn(player.recording.stamp + 2.0)
    assert len(player.recording.messages("/level")) == count


def test_a_node_without_parameter_services_times_out(capsys):
    def mute():
        return Node("mute", start_parameter_services=False)

    made = player(mute, seconds=60, speed=math.inf, clock=perf_counter)
    ros2("param list")
    assert capsys.readouterr().out == "Wait for service timed out waiting for /mute/list_parameters\n"
    made.stop()


def test_a_player_that_has_ended_is_the_last_recording(playing):
    recording = playing.player.result()
    assert latest.player is None
    assert latest.recording is recording
    assert playing("topic hz /place").startswith("average rate: 10.000\n")


def test_a_player_that_ends_during_a_command_is_reported(playing):
    while playing.player.recording.stamp < 198.9:
        playing.player.play_frame(199.0)
    assert playing("service call /ad example_interfaces/srv/AddTwoInts").endswith(
        "Nothing came of it before the play ended.\n"
    )


def test_a_bag_is_recorded_described_and_played_back(playing):
    said = playing("bag record -o kept --topics /place /greeting /levl")
    assert said == (
        "WARNING: topic [/levl] does not appear to be published yet. Did you mean /level?\n"
        "Subscribed to topic '/greeting'\nSubscribed to topic '/place'\n"
        "Recording stopped: 51 messages in kept\n"
    )
    info = playing("bag info kept").splitlines()
    assert info[1] == "Files:             kept_0.mcap"
    assert info[3:6] == [
        "Storage id:        mcap", "ROS Distro:        jazzy", "Duration:          5.000000000s",
    ]  # fmt: skip
    row = "Topic: {} | Type: {} | Count: {} | Serialization Format: cdr"
    assert info[8:] == [
        "Messages:          51",
        "Topic information: " + row.format("/greeting", "std_msgs/msg/String", 1),
        "                   " + row.format("/place", "geometry_msgs/msg/PointStamped", 50),
        "Service:           0",
        "Service information: ",
    ]
    for schema, channel, message in Bag(Path("kept")).messages():
        if channel.topic == "/place":  # stamped as it is sent
            stamp = decode(schema.name, message.data).header.stamp
            assert message.log_time == stamp.sec * 1_000_000_000 + stamp.nanosec > 1_735_689_600_000_000_000
    assert playing("bag info -t kept") == "/greeting\n/place\n"
    before = len(playing.player.recording.messages("/place"))
    assert playing("bag play -r 5 kept --topics /place").endswith("\nPlayed 50 messages from kept\n")
    again = playing.player.recording.messages("/place")[before:]
    assert sum(received.sender != "/talker" for received in again) == 50
    assert playing("bag record -a -o kept") == "Output folder 'kept' already exists.\n"
