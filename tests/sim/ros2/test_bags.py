"""ros2 bag: what is recorded, played, copied and repaired, in a run."""

import signal
from itertools import pairwise
from pathlib import Path

import pytest
import yaml
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from std_msgs.msg import Float64, String

from sim import run
from sim.ros.bags.bag_files import Bag, BagWriter
from sim.ros2.cli_program import terminal
from sim.ros2.notebook import ros2
from sim.ros2.uninterrupted import uninterrupted


class Source(Node):
    """Numbers at 10 Hz, a text once a second, and a service that it calls once a second."""

    def __init__(self):
        super().__init__("source")
        numbers, values = self.create_publisher(Float64, "level", 10), iter(range(1000))
        texts = self.create_publisher(String, "text", 10)
        self.create_timer(0.1, lambda: numbers.publish(Float64(data=float(next(values)))))
        self.create_timer(1.0, lambda: texts.publish(String(data="hello")))
        self.service = self.create_service(AddTwoInts, "add", lambda request, response: response)
        state = ServiceIntrospectionState.CONTENTS
        self.service.configure_introspection(self.get_clock(), qos_profile_system_default, state)
        self.client = self.create_client(AddTwoInts, "add")
        self.create_timer(1.0, lambda: self.client.call_async(AddTwoInts.Request()))


class Sink(Node):
    def __init__(self):
        super().__init__("sink")
        self.create_subscription(Float64, "level", lambda message: None, 10)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def printed(capsys):
    def printed(words):
        ros2(words)
        return capsys.readouterr().out

    return printed


def recorded(words, seconds=2.15):
    """Topic to number of messages of what `ros2 bag record` with these words records."""
    recording = run(Source, terminal(f"ros2 bag record -o kept {words}"), seconds=seconds, quiet=True)
    assert recording.errors == []
    return dict(Bag(Path("kept")).contents.counts)


EVENTS = "/add/_service_event"


@pytest.mark.parametrize(
    ("words", "counts"),
    [
        ("/level", {"/level": 20}),
        ("--topics /level /text", {"/level": 20, "/text": 2}),
        ("--services /add", {EVENTS: 4}),
        ("--all-services", {EVENTS: 4}),
        ("--topic-types std_msgs/msg/String", {"/text": 2}),
        ("-e ^/t", {"/text": 2}),
        ("-e 'level|add' --exclude-regex add", {"/level": 20}),
    ],
)
def test_what_is_selected_is_recorded(words, counts):
    assert recorded(words) == counts


def test_all_leaves_out_hidden_topics_and_those_that_are_excluded():
    found = recorded("-a --exclude-topics /level")
    assert {"/text", EVENTS} <= set(found) and "/level" not in found
    assert [name for name in found if "/_" in name] == [EVENTS]


def test_a_summary_lists_services_apart(printed):
    recorded("--topics /text --services /add")
    row = "Event Count: 4 | Serialization Format: cdr"
    assert printed("bag info kept").splitlines()[8:] == [
        "Messages:          2",
        "Topic information: Topic: /text | Type: std_msgs/msg/String | Count: 2 | Serialization Format: cdr",
        "Service:           1",
        f"Service information: Service: /add | Type: example_interfaces/srv/AddTwoInts | {row}",
    ]
    assert printed("bag info -t kept") == "/text\n"


def test_lost_metadata_is_made_again(printed):
    recorded("/level")
    file = Path("kept", "metadata.yaml")
    before = file.read_text()
    assert "&id" not in before  # an anchor
    file.unlink()
    assert printed("bag reindex kept") == (
        "Beginning reindexing bag in directory: kept\nReindexing complete.\n"
    )
    assert file.read_text() == before
    assert printed("bag reindex kept/kept_0.mcap") == "Must specify a bag directory\n"


def test_bags_are_split_and_merged(printed):
    recorded("--topics /level /text --services /add")
    outputs = [{"uri": "numbers", "topics": ["/level"]}, {"uri": "calls", "all_services": True}]
    Path("split.yaml").write_text(yaml.safe_dump({"output_bags": outputs}))
    assert printed("bag convert -i kept -o split.yaml") == ""
    assert dict(Bag(Path("numbers")).contents.counts) == {"/level": 20}
    assert dict(Bag(Path("calls")).contents.counts) == {EVENTS: 4}
    merged = {"uri": "merged", "all_topics": True, "all_services": True}
    Path("merge.yaml").write_text(yaml.safe_dump({"output_bags": [merged]}))
    assert printed("bag convert -i calls mcap -i numbers -o merge.yaml") == ""
    assert dict(Bag(Path("merged")).contents.counts) == {"/level": 20, EVENTS: 4}
    stamps = [message.log_time for _, _, message in Bag(Path("merged")).messages()]
    assert stamps == sorted(stamps)


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (None, "out.yaml can't be read: No such file or directory.\n"),
        ("{", "out.yaml is not YAML: "),
        (
            "bags: []",
            "out.yaml has no list of output_bags, each with a uri, such as "
            "output_bags: [{uri: new_bag, all_topics: true}].\n",
        ),
        (
            "output_bags: [{uri: small, compression_mode: file}]",
            "out.yaml: small can't be compressed here: leave out compression_mode.\n",
        ),
        (
            "output_bags: [{uri: other, storage_id: sqlite3}]",
            "out.yaml: other can't be in another format than mcap here: leave out storage_id.\n",
        ),
        (
            "output_bags: [{uri: parts, storage_id: mcap, max_bagfile_size: 1000}]",
            "out.yaml: parts can't be split into several files here: leave out max_bagfile_size.\n",
        ),
        (
            "output_bags: [{uri: new, regex: '('}]",
            "'(' is not a regular expression: missing ), unterminated subpattern at position 0.\n",
        ),
    ],
)
def test_why_a_bag_is_not_converted(printed, text, answer):
    recorded("/text")
    if text is not None:
        Path("out.yaml").write_text(text)
    assert printed("bag convert -i kept -o out.yaml").startswith(answer)


def test_a_bag_has_one_format(printed):
    recorded("/text")
    assert printed("bag list storage") == "mcap\n"
    assert printed("bag list converter -v") == "available converter plugins are:\n"
    assert printed("bag list storage -v") == (
        "available storage plugins are:\nname: mcap\n"
        "\tReads and writes MCAP files, with the libraries mcap and PyYAML\n"
    )
    Path("out.yaml").write_text("output_bags: [{uri: new}]")
    assert printed("bag convert -i kept db3 -o out.yaml") == (
        "--input expects a bag and, at most, its format, mcap or sqlite3; it has kept db3.\n"
    )
    assert printed("bag record -s sqlite3 /text").endswith("there is no 'sqlite3', only mcap.\n")


def played(words, seconds):
    """Stamps and values on /level and /other while `ros2 bag play kept` with these words is executed."""
    recording = run(Sink, terminal(f"ros2 bag play kept {words}"), seconds=seconds, quiet=True)
    assert recording.errors == []
    return {
        topic: [(round(row.stamp, 3), row.message.data) for row in recording.messages(topic)]
        for topic in ("/level", "/other", "/text")
    }, "".join(text for _, text in recording.prints)


def test_a_bag_is_played_from_an_offset_for_a_while_under_other_names():
    recorded("/level /text")
    found, words = played("--start-offset 0.5 --playback-duration 0.3 -m /level:=/other", 4)
    first = found["/other"][0][0]
    assert found["/other"] == [(round(first + 0.1 * i, 3), 6.0 + i) for i in range(4)]
    assert (found["/level"], found["/text"]) == ([], [(found["/other"][-1][0], "hello")])
    assert words == "Playing 5 messages on /level, /text: 0.3 s\nPlayed 5 messages from kept\n"


def test_a_bag_is_played_again_and_again_each_time_after_a_pause():
    recorded("/level", seconds=0.55)
    (found, _) = played("--loop --delay 1.0 -r 2", 5)
    stamps = [stamp for stamp, value in found["/level"] if value == 1.0]
    assert [round(later - earlier, 3) for earlier, later in pairwise(stamps)] == [1.15] * 3
    assert [value for _, value in found["/level"]][:8] == [1.0, 2.0, 3.0, 4.0] * 2


@pytest.mark.parametrize(
    ("words", "values"),
    [("-e ^/l", 20), ("-x lev", 0), ("--exclude-topics /level", 0), ("--topics /level", 20)],
)
def test_what_is_selected_is_played(words, values):
    recorded("/level /text")
    assert len(played(words, 4)[0]["/level"]) == values


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("--topics /none", "kept has no such messages.\n"),
        ("-m /level", "'/level' is not a remapping, such as /old:=/new.\n"),
        ("--start-offset -1", "argument --start-offset: Value -1 is less than zero.\n"),
        ("--start-offset x", "argument --start-offset: x is not the valid type (float)\n"),
    ],
)
def test_why_a_bag_is_not_played(words, answer):
    recorded("/level")
    assert played(words, 3)[1].endswith(answer)


def test_the_time_of_a_bag_is_no_clock_in_a_run():
    recorded("/level")
    recording = run(Sink, terminal("ros2 bag play kept --clock"), seconds=3, quiet=True)
    assert [error.type for error in recording.errors] == ["NotImplementedError"]


class Interrupting:
    """A stamp (ns): while it is written, Ctrl-C is pressed twice."""

    def __index__(self):
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        return 1


def test_ctrl_c_while_a_message_is_written_leaves_a_bag_that_can_be_read(tmp_path):
    folder = tmp_path / "kept"
    with pytest.raises(KeyboardInterrupt), uninterrupted() as interrupts, BagWriter(folder) as writer:
        writer.write("/fixed", "example_interfaces/msg/Bool", b"\0\1\0\0\1", (1, Interrupting()), {})
        assert interrupts == [signal.SIGINT, signal.SIGINT]
    assert Bag(folder).contents.counts == {"/fixed": 1}
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
