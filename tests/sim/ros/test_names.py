"""Names, parameters, QoS, lifecycle and the graph, as a launch file or the code itself sets them."""

import inspect
import math

import numpy as np
import pytest
from rclpy.impl.rcutils_logger import CallerId
from rclpy.node import Node

from sim import Process, run
from tests.sim.ros.evidence import logged, raised, values, why
from tests.students.engine import names

SETTINGS = {
    "name": "bob", "namespace": "/r1", "remappings": [("chatter", "/other")],
    "parameters": {"rate": 2.0, "word": 'say "hi" \\ 5', "words": ["x", "y"]},
}  # fmt: skip


def sent(target, seconds=1):
    """(topic, sender, word) of what was published in the last moment."""
    recording = run(target, seconds=seconds, quiet=True)
    assert recording.errors == []
    received = recording.messages()[-1]
    return received.topic, received.sender, received.message.data


@pytest.mark.parametrize("target", [names.Talker, names.arguments_from_the_command_line])
def test_process_sets_names_and_parameters(target):
    assert sent(target) == ("/chatter", "/talker", "hello")
    assert sent(Process(target, **SETTINGS)) == ("/other", "/r1/bob", 'say "hi" \\ 5')
    assert len(run(Process(target, **SETTINGS), seconds=2, quiet=True).messages("/other")) == 4


def test_process_takes_command_line_words():
    words = ["--ros-args", "-r", "chatter:=lines", "-p", "word:=hi"]
    assert sent(Process(names.Talker, arguments=words)) == ("/lines", "/talker", "hi")


def test_a_function_may_return_a_process():
    assert sent(names.launches) == ("/chatter", "/launched", "go")


def test_arguments_to_init_are_followed():
    assert sent(names.arguments_to_init) == ("/r2/said", "/r2/al", "hi")
    assert sent(Process(names.arguments_to_init, **SETTINGS)) == ("/r2/said", "/r2/al", "hi")


def test_arguments_to_one_node_are_followed():
    assert sent(names.arguments_to_node) == ("/r3/chatter", "/r3/talker", "own")


def test_a_nodes_own_parameters_win():
    assert sent(Process(names.arguments_to_node, parameters={"word": "general"}))[2] == "own"


def test_a_node_may_ignore_global_arguments():
    assert sent(Process(names.not_for_this_node, **SETTINGS)) == ("/chatter", "/talker", "hello")


@pytest.mark.parametrize(
    ("given", "read"),
    [
        (True, True), (-2, -2), (1e-7, 1e-7), (math.inf, math.inf), ("3", "3"), ("é", "é"),
        ('a "b": c\\\n', 'a "b": c\\\n'), ((1, 2), [1, 2]),
        (["yes", "# no"], ["yes", "# no"]), (range(2), [0, 1]),
        (np.float64(2.5), 2.5), (np.array([1, 2]), [1, 2]),
    ],
)  # fmt: skip
def test_a_parameter_of_a_program_is_read_as_it_was_given(given, read):
    seen = []

    class Reader(Node):
        def __init__(self):
            super().__init__("reader", automatically_declare_parameters_from_overrides=True)
            seen.append(self.get_parameter("given").value)

    run(Process(Reader, parameters={"given": given}), seconds=1, quiet=True)
    (value,) = seen
    assert (list(value) if isinstance(read, list) else value) == read


def test_two_of_a_kind_are_distinguished_by_namespace():
    pair = [Process(names.Talker, namespace=name) for name in ("/robot1", "robot2")]
    recording = run(*pair, seconds=1, quiet=True)
    assert recording.topics == {
        "/robot1/chatter": "std_msgs/msg/String", "/robot2/chatter": "std_msgs/msg/String",
    }  # fmt: skip
    assert [received.sender for received in recording.messages()] == ["/robot1/talker", "/robot2/talker"]


def test_a_late_joiner_gets_the_last_latched_messages():
    recording = run(names.LatchedTalker, names.late_listener, seconds=3, quiet=True)
    assert logged(recording) == [(2.0, "1"), (2.0, "2"), (2.0, "3")]
    (publisher,) = recording.graph.publishers("/map")
    assert publisher.qos == {
        "reliability": "reliable", "durability": "transient_local", "history": "keep_last", "depth": 3,
        "liveliness": "automatic", "deadline": None, "lifespan": None, "liveliness_lease_duration": None,
    }  # fmt: skip


def test_the_depth_of_a_queue_drops_the_oldest():
    texts = [text for _, text in logged(run(names.Bursts, seconds=1, quiet=True))]
    assert [text for text in texts if text.startswith("2:")] == ["2: 3", "2: 4"]
    assert [text for text in texts if text.startswith("10:")] == [f"10: {number}" for number in range(5)]


def test_qos_that_does_not_match_is_warned_of_and_delivers_nothing():
    recording = run(names.Mismatch, seconds=2, quiet=True)
    assert logged(recording) == [
        (0.0, "New subscription discovered on topic 'data', requesting incompatible QoS. "
              "No messages will be sent to it. Last incompatible policy: RELIABILITY"),
        (0.0, "New publisher discovered on topic 'data', offering incompatible QoS. "
              "No messages will be received from it. Last incompatible policy: RELIABILITY"),
    ]  # fmt: skip
    assert values(recording, "/data") == [(1.0, 0), (2.0, 0)]


def test_wait_for_message_takes_one_or_gives_up():
    recording = run(names.waits_for_message, names.Talker, seconds=3, quiet=True)
    assert logged(recording) == [(1.0, "True hello"), (1.5, "False None")]


def test_a_lifecycle_node_publishes_while_it_is_active():
    recording = run(names.lifecycle, seconds=4, quiet=True)
    assert logged(recording) == [(0.75, "configured"), (3.0, "cleaned up")]
    assert [stamp for stamp, _ in values(recording, "/count")] == [1.75]
    assert raised(recording) == []


def test_entities_may_come_and_go():
    recording = run(names.Restless, seconds=4, quiet=True)
    assert logged(recording) == [(1.4, "received"), (1.8, "received"), (3.4, "received"), (3.8, "received")]
    assert why(recording) == ("time", 4.0, "All 4 s were run.")


def test_a_node_sees_the_others_in_the_graph():
    assert logged(run(names.Introspective, names.Talker, seconds=1, quiet=True)) == [
        (1.0, "['asker', 'talker'] ['/chatter']"), (1.0, "1 0"),
    ]  # fmt: skip


def lines_of(*programs):
    return [(line.node, line.text) for line in run(*programs, seconds=1, quiet=True).logs]


def test_log_levels_are_those_of_a_program_or_of_a_logger():
    usual = [("logs", "info"), ("logs", "warning")]
    loud = Process(names.Logs, name="loud", arguments=["--ros-args", "--log-level", "debug"])
    still = Process(names.Logs, name="still", arguments=["--ros-args", "--log-level", "still:=WARN"])
    assert lines_of(loud, names.Logs, still) == [
        ("loud", "debug"), ("loud", "info"), ("loud", "warning"), *usual, ("still", "warning"),
    ]  # fmt: skip
    assert lines_of(names.Logs) == usual


def test_a_program_may_keep_its_log_lines_from_rosout():
    silent = Process(names.Logs, name="silent", arguments=["--ros-args", "--disable-rosout-logs"])
    recording = run(names.ReceivesLogs, silent, names.Logs, seconds=1, quiet=True)
    received = [(stamp, text) for stamp, text in recording.prints if text.strip()]
    assert received == [(1.0, "logs: info"), (1.0, "logs: warning")]


def test_the_place_of_a_log_line_is_known_without_reading_sources(monkeypatch):
    lines, first = inspect.getsourcelines(names.Logs.tick)
    rows = [first + row for row, line in enumerate(lines) if "info" in line or "warning" in line]
    asked = []
    monkeypatch.setattr(inspect, "getmodule", asked.append)  # it looks at all modules, for a cell's code
    recording = run(names.ReceivesPlaces, names.Logs, seconds=1, quiet=True)
    places = [text.strip() for _, text in recording.prints if text.strip()]
    assert places == [f"{names.__file__} tick {row}" for row in rows]
    assert asked == []


def test_outside_a_run_a_log_line_is_placed_as_rclpy_does():
    run(names.Logs, seconds=1, quiet=True)
    place = CallerId()
    assert (place.function_name, place.file_path) == (inspect.currentframe().f_code.co_name, __file__)
    assert CallerId(inspect.currentframe()).line_number == place.line_number + 2
