"""Recordings: what they answer, what they keep on disk, and what others can read of it."""

import json
import random
from dataclasses import replace

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from rclpy.node import Node
from std_msgs.msg import Int32

from sim import Process, Recording, run
from sim.evidence import Call, Ended, Goal, Message, rate, stamps
from sim.evidence.storage import ATTACHMENT, FORMAT, StorageError
from sim.nanoseconds import EPOCH
from sim.ros.messages.codec import encode
from sim.ros.messages.decoder import decode
from tests.students.engine import actions, errors, mains, names, services, threads, topics

CALL = Call("/add", "example_interfaces/srv/AddTwoInts", "/customer", b"\0\1\0\0", 1.0)
CALLS = [
    CALL,
    replace(CALL, requested=1.1),
    replace(CALL, raw_response=b"\0"),
    replace(CALL, raised="KeyError"),
]
GOAL = Goal("/fibonacci", "example_interfaces/action/Fibonacci", "/customer", "00" * 16, b"\0\1\0\0", 1.0)
GOALS = [GOAL, replace(GOAL, received=1.5), replace(GOAL, events=[(1.0, "accepted")])]


class Ticker(Node):
    def __init__(self):
        super().__init__("ticker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().info("tick")


class Faulty(Ticker):
    def tick(self):
        return 1 / 0


@pytest.fixture(scope="module")
def driven():
    """A robot and nodes with topics, services, actions, errors, log lines and prints."""

    def prints():
        print("hello")

    programs = [
        mains.classic, names.LatchedTalker, services.Adder, services.done_callback, actions.Server,
        actions.Client, errors.InTimer, threads.queues, prints, topics.SaysItAtOnce,
    ]  # fmt: skip
    return run(*programs, world="room", seconds=3, seed=5, quiet=True)


def refused(path):
    """The words with which a file is refused."""
    with pytest.raises(StorageError) as caught:
        Recording.load(path)
    return str(caught.value)


def test_messages_are_found_by_topic_and_sender(driven):
    received = driven.messages("/count")
    assert [(h.stamp, h.topic, h.type, h.sender) for h in received[:2]] == [
        (0.5, "/count", "std_msgs/msg/Int32", "/counter"), (1.0, "/count", "std_msgs/msg/Int32", "/counter"),
    ]  # fmt: skip
    assert driven.messages("/count", sender="/counter") == received
    assert driven.messages("/count", sender="/robot") == []
    assert driven.messages(sender="/counter") == received
    assert driven.messages("count") == []


def test_chatter_of_ros_itself_is_shown_only_when_asked_for(driven):
    assert {h.topic for h in driven.messages()}.isdisjoint({"/clock", "/parameter_events", "/rosout"})
    assert len(driven.messages("/clock")) == 61


def test_each_reader_gets_a_copy_of_a_message(driven):
    received = driven.messages("/count")[0]
    received.message.data = 99
    assert received.message == Int32(data=1)


def test_topics_are_sorted_and_typed(driven):
    assert list(driven.topics) == sorted(driven.topics)
    assert driven.topics["/count"] == "std_msgs/msg/Int32"
    assert driven.topics["/scan"] == "sensor_msgs/msg/LaserScan"
    assert "/clock" not in driven.topics


def test_a_recording_says_what_it_is(driven):
    assert repr(driven) == (
        f"<Recording of 3 s: {len(driven.published)} messages on {len(driven.topics)} topics, "
        f"{len(driven.logs)} log lines, 1 errors, ended: error; "
        "ZeroDivisionError: division by zero (in InTimer.tick, line 26, at 1 s)>"
    )
    assert Recording().ended.reason == "running"


def test_rates_and_stamps():
    message = [Message(stamp, "/a", "std_msgs/msg/Int32", "/b", encode(Int32())) for stamp in (1.0, 1.5, 2.0)]
    assert stamps(message) == [1.0, 1.5, 2.0]
    assert rate(stamps(message)) == 2.0
    assert rate([1.0]) == rate([]) == rate([1.0, 1.0]) == 0.0


def test_the_digest_depends_on_all_evidence_and_not_on_what_was_printed():
    sent = Message(1.0, "/a", "std_msgs/msg/Int32", "/b", encode(Int32()))
    plain = Recording(published=[sent])
    assert plain.digest == Recording(published=[sent], prints=[(1.0, "x")], stderr="y").digest
    others = [
        Recording(published=[sent._replace(stamp=1.1)]), Recording(published=[sent._replace(topic="/c")]),
        Recording(published=[sent._replace(sender="/d")]), Recording(published=[sent._replace(early=True)]),
        Recording(published=[sent._replace(raw=b"\0\1\0\0\1")]),
        Recording(published=[sent, sent]), Recording(published=[sent], ended=Ended("goal", 1.0, "")),
        Recording(published=[sent], seed=1), Recording(published=[sent], seconds=1),
        *(Recording(published=[sent], calls=[call]) for call in CALLS),
        *(Recording(published=[sent], goals=[goal]) for goal in GOALS),
    ]  # fmt: skip
    assert len({recording.digest for recording in [plain, *others]}) == len(others) + 1
    assert len(plain.digest) == 32 and int(plain.digest, 16)


def test_a_saved_recording_comes_back_equal(driven, tmp_path):
    path = driven.save(tmp_path / "run.mcap")
    assert path == tmp_path / "run.mcap"
    again = Recording.load(path)
    assert again == driven
    assert again.digest == driven.digest
    assert again.world == driven.world and again.contacts == driven.contacts
    assert again.graph.publishers("/count") == driven.graph.publishers("/count")
    assert again.prints == [(0.0, "hello"), (0.0, "\n")]
    assert {received.early for received in again.messages("/words")} == {True, False}
    assert again.calls == driven.calls and again.calls[0].response.sum == 5
    assert again.goals == driven.goals and again.goals[0].feedback[0].message.sequence[2] == 1


def test_saving_twice_gives_the_same_bytes(driven, tmp_path):
    first, second = (driven.save(tmp_path / name).read_bytes() for name in ("a.mcap", "b.mcap"))
    assert first == second
    assert Recording.load(str(tmp_path / "a.mcap")).save(tmp_path / "c.mcap").read_bytes() == first


def test_an_empty_recording_comes_back_too(tmp_path):
    assert Recording.load(Recording().save(tmp_path / "empty.mcap")) == Recording()


def test_the_world_comes_back_as_it_was(tmp_path):
    for world in ("corridor", "maze", "room", "yard"):
        recording = run(world=world, seconds=0.1, quiet=True)
        assert Recording.load(recording.save(tmp_path / "w.mcap")).world == recording.world


def test_others_can_read_the_messages(driven, tmp_path):
    """With the mcap library alone: profile, schemas with their definitions, times and bytes."""
    with driven.save(tmp_path / "run.mcap").open("rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros2"
        read = list(reader.iter_messages(log_time_order=False))
        counts = list(reader.iter_messages(topics=["/count"]))
    assert len(read) == len(driven.published)
    assert [message.log_time for _, _, message in counts] == [EPOCH + n * 500_000_000 for n in range(1, 7)]
    schema, channel, message = counts[0]
    assert (schema.name, schema.encoding, channel.message_encoding) == (
        "std_msgs/msg/Int32",
        "ros2msg",
        "cdr",
    )
    assert schema.data.decode().splitlines()[-1] == "int32 data"
    assert decode(schema.name, message.data) == Int32(data=1)
    odometry = next(s.data.decode() for s, c, _ in read if c.topic == "/odom")
    assert [line for line in odometry.splitlines() if line.startswith("MSG: ")] == [
        "MSG: builtin_interfaces/Time", "MSG: geometry_msgs/Point", "MSG: geometry_msgs/Pose",
        "MSG: geometry_msgs/PoseWithCovariance", "MSG: geometry_msgs/Quaternion", "MSG: geometry_msgs/Twist",
        "MSG: geometry_msgs/TwistWithCovariance", "MSG: geometry_msgs/Vector3", "MSG: std_msgs/Header",
    ]  # fmt: skip


def test_a_missing_file_is_refused(tmp_path):
    path = tmp_path / "none.mcap"
    assert refused(path) == f"{path} can't be read: No such file or directory."
    assert refused(tmp_path) == f"{tmp_path} can't be read: Is a directory."


@pytest.mark.parametrize("content", [b"", bytes(1000)], ids=range(2))
def test_a_file_of_another_kind_is_refused(tmp_path, content):
    path = tmp_path / "other.mcap"
    path.write_bytes(content)
    assert refused(path).startswith(f"{path} is not an MCAP file, or it is damaged (")


@pytest.mark.parametrize("part", [0.2, 0.5, 0.9, 0.999])
def test_a_file_that_was_cut_off_is_refused(driven, tmp_path, part):
    whole = driven.save(tmp_path / "whole.mcap").read_bytes()
    path = tmp_path / "cut.mcap"
    path.write_bytes(whole[: int(len(whole) * part)])
    assert refused(path).startswith(f"{path} is not an MCAP file, or it is damaged (")


@pytest.mark.parametrize("content", [b"hello", b"\x89MCAP0\r\n"], ids=range(2))
def test_a_very_short_file_is_refused(tmp_path, content):
    path = tmp_path / "short.mcap"
    path.write_bytes(content)
    assert refused(path).startswith(f"{path} is not an MCAP file, or it is damaged (")


def test_a_damaged_file_is_refused_or_read_in_full(driven, tmp_path):
    """One changed byte: never another exception, never a half-read recording."""
    whole = driven.save(tmp_path / "whole.mcap").read_bytes()
    path, chance = tmp_path / "damaged.mcap", random.Random(1)
    for _ in range(40):
        damaged = bytearray(whole)
        damaged[chance.randrange(len(whole))] ^= 0xFF
        path.write_bytes(damaged)
        try:
            again = Recording.load(path)
        except StorageError as error:
            assert str(path) in str(error)
        else:
            assert len(again.published) == len(driven.published)


def mcap_with(path, attachments):
    """An MCAP file with these attachments and nothing else."""
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        for name, data in attachments.items():
            writer.add_attachment(0, 0, name, "application/json", data)
        writer.finish()
    return path


def test_someone_elses_mcap_file_is_refused(tmp_path):
    path = mcap_with(tmp_path / "foreign.mcap", {"notes.txt": b"hi"})
    assert refused(path) == (
        f"{path} is an MCAP file, but not a recording that this course saved: it has no {ATTACHMENT}."
    )


def test_a_newer_format_is_refused(tmp_path):
    path = mcap_with(tmp_path / "new.mcap", {ATTACHMENT: json.dumps({"format": FORMAT + 1}).encode()})
    assert refused(path) == (
        f"{path} has format {FORMAT + 1} of a recording; this version of the course reads {FORMAT}."
    )


@pytest.mark.parametrize("data", [b"not json", b"[]", b"{}", b'{"format": 1}', b"\xff\xfe"], ids=range(5))
def test_a_damaged_attachment_is_refused(tmp_path, data):
    path = mcap_with(tmp_path / "bad.mcap", {ATTACHMENT: data})
    assert str(path) in refused(path)


def test_a_window_of_time_is_a_recording():
    whole = run(Ticker, world="yard", seconds=4, quiet=True)
    part = whole.during(1.5, 3.0)
    assert [line.stamp for line in part.logs] == [2.0]
    assert [round(pose.stamp, 3) for pose in (part.path[0], part.path[-1])] == [1.5, 2.95]
    assert (part.begin, part.stamp, part.ended.stamp, part.graph) == (1.5, 3.0, 3.0, whole.graph)
    assert {1.5 <= received.stamp < 3.0 for received in part.published} == {True}
    assert [line.stamp for line in part.during(0.0).logs] == [2.0]
    assert [line.stamp for line in whole.during(3.0).logs] == [3.0, 4.0]


def test_the_pose_at_a_time():
    driven = run(world="yard", seconds=1)
    assert driven.pose_at(0.5).stamp == pytest.approx(0.5)
    assert driven.pose_at(7.0) == driven.path[-1]
    with pytest.raises(ValueError, match=r"^this run has no robot: give the exercise a world$"):
        run(Ticker, seconds=1, quiet=True).pose_at(0.5)


def test_a_recording_knows_whose_nodes_are_whose():
    pilot = Process(Ticker, name="pilot", namespace="/tower")
    both = run(Ticker, companions=[pilot], world="yard", seconds=1, quiet=True)
    assert both.course_nodes == {"/robot", "/tower/pilot"}
    assert [both.is_course_node(name) for name in ("/tower/pilot", "tower.pilot", "/ticker", "ticker")] == [
        True, True, False, False
    ]  # fmt: skip


def test_a_students_node_that_takes_the_name_of_the_course_makes_it_vouch_for_nothing():
    both = run(Ticker, companions=[Ticker], seconds=1, quiet=True)
    assert (both.course_nodes, both.shared) == (set(), {"/ticker"})


def test_who_sent_logged_asked_and_served_is_known_by_program_and_not_by_name(tmp_path):
    other = run(Ticker, mains.classic, actions.Server, companions=[services.Adder], seconds=2, quiet=True)
    own = run(
        services.done_callback, companions=[Ticker, mains.classic, services.Adder], seconds=2, quiet=True
    )
    both = run(Ticker, mains.classic, companions=[Ticker, mains.classic], seconds=2, quiet=True)
    for made, reported in ((other, {False}), (own, {True}), (both, {False, True})):
        assert {received.from_course for received in made.messages("/count")} == reported
        assert {end.from_course for end in made.graph.publishers("/count")} == reported
        assert {line.from_course for line in made.logs if line.node == "ticker"} == reported
    calls = own.calls_of("/add")
    assert {(call.requested_by_course, call.served_by_course) for call in calls} == {(False, True)}
    assert Recording.load(both.save(tmp_path / "both.mcap")).published == both.published


def test_a_goal_knows_whose_client_and_server_it_has():
    nodes = actions.Client, actions.Server
    for asked, served in ((True, False), (False, True), (False, False), (True, True)):
        companions = [
            node for node, is_course_node in zip(nodes, (asked, served), strict=True) if is_course_node
        ]
        students = [node for node in nodes if node not in companions]
        goals = run(*students, companions=companions, seconds=3, quiet=True).goals
        assert {(goal.requested_by_course, goal.served_by_course) for goal in goals} == {(asked, served)}
        assert {received.from_course for goal in goals for received in goal.feedback} == {served}


def test_an_error_of_a_companion_is_a_failure_of_the_course():
    faulty = run(Ticker, companions=[Process(Faulty)], seconds=2, quiet=True)
    assert [error.type for error in faulty.course_errors] == ["ZeroDivisionError"]
    assert faulty.course_errors == faulty.errors
    assert run(Faulty, seconds=2, quiet=True).course_errors == []
