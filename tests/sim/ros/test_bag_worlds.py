"""A bag as the world of a run that this course or rosbags has written, in MCAP or in SQLite's format."""

import sqlite3
from pathlib import Path

import pytest
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from std_msgs.msg import String

from sim import World, play, run
from sim.nanoseconds import EPOCH, SECOND
from sim.ros.bags.bag_error import BagError
from sim.ros.bags.bag_files import Bag
from sim.ros2.notebook import ros2

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LATER = 1_790_000_000 * SECOND  # in September 2026
TYPES = get_typestore(Stores.ROS2_JAZZY)


class Talker(Node):
    """A latched text at the start, a best-effort pose at 10 Hz, and a text once a second."""

    def __init__(self):
        super().__init__("talker")
        self.create_publisher(String, "/name", LATCHED).publish(String(data="robot"))
        self.poses = self.create_publisher(PoseStamped, "/pose", qos_profile_sensor_data)
        self.texts = self.create_publisher(String, "/text", 10)
        self.create_timer(0.1, self.move)
        self.create_timer(1.0, lambda: self.texts.publish(String(data="hello")))

    def move(self):
        pose = PoseStamped()
        pose.header.stamp = self.get_clock().now().to_msg()
        self.poses.publish(pose)


class Listener(Node):
    """Notes what it receives, when by its clock, and what lies between stamp and clock."""

    def __init__(self):
        super().__init__("listener")
        self.rows = []
        best_effort = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
        for kind, topic, qos in (
            (String, "/name", LATCHED),
            (PoseStamped, "/pose", best_effort),
            (String, "/text", 10),
        ):
            self.create_subscription(kind, topic, lambda msg, topic=topic: self.note(topic, msg), qos)

    def note(self, topic, msg):
        now = self.get_clock().now().nanoseconds
        self.rows.append((topic, now))
        self.get_logger().info(f"{topic} {now}")


class Demanding(Node):
    def __init__(self):
        super().__init__("demanding")
        self.create_subscription(PoseStamped, "/pose", self.fail, 10)

    def fail(self, msg):
        raise AssertionError("best effort doesn't match reliable")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def talk():
    return run(Talker, seconds=3.05, quiet=True)


def received(recording):
    """Topic and the node's clock of each message that a Listener has received."""
    lines = [line.text for line in recording.logs if line.node == "listener" and line.level == "INFO"]
    return [(topic, int(now)) for topic, now in map(str.split, lines)]


def test_messages_are_published_when_they_were_recorded_and_clocks_show_that_time(talk):
    bag = talk.save_bag("talk", delay=0.0, jitter=0.0)
    found = run(Listener, bag=bag, quiet=True)
    stored = sorted((message.log_time, channel.topic) for _, channel, message in Bag(Path(bag)).messages())
    early = EPOCH + SECOND // 1000  # what was recorded at 0 s comes as soon as programs know each other
    assert sorted(received(found), key=lambda row: row[1]) == [
        (topic, max(moment, early)) for moment, topic in stored
    ]
    assert [row.raw for row in found.messages("/pose")] == [row.raw for row in talk.messages("/pose")]
    assert found.ended.stamp == pytest.approx(talk.messages("/pose")[-1].stamp + 1.0)
    assert all(row.from_course for row in found.messages("/pose")) and found.errors == []


def test_a_bag_is_played_with_its_qos(talk):
    found = run(Listener, Demanding, bag=talk.save_bag("talk"), quiet=True)
    offered = {end.name: (end.qos["reliability"], end.qos["durability"]) for end in found.graph.publishers()}
    assert offered["/pose"] == ("best_effort", "volatile")
    assert offered["/name"] == ("reliable", "transient_local")
    assert offered["/text"] == ("reliable", "volatile")
    assert found.errors == []


def test_a_latched_message_reaches_a_node_that_starts_later(talk):
    bag = talk.save_bag("talk")
    live = play(bag=bag, speed=float("inf"), seconds=3)
    assert live.result().messages("/name")
    late = run(lambda: Listener(), bag=bag, quiet=True, order="k3f9")
    assert [topic for topic, _ in received(late)].count("/name") == 1


def test_equal_plays_have_equal_digests_and_a_play_differs_from_no_bag(talk):
    bag = talk.save_bag("talk")
    digests = {run(Listener, bag=bag, quiet=True).digest for _ in range(3)}
    assert len(digests) == 1 and run(Listener, seconds=4.0, quiet=True).digest not in digests


def test_a_recording_of_a_play_is_saved_and_loaded_with_its_time(talk):
    bag = written(StoragePlugin.MCAP)
    found = run(Listener, bag=bag, quiet=True)
    again = type(found).load(found.save("play.mcap"))
    assert again.epoch == found.epoch == LATER and again.digest == found.digest
    found.save_bag("copy", delay=0.0, jitter=0.0)
    assert Bag(Path("copy")).contents.begin == LATER + SECOND // 1000


def test_rosbags_reads_what_is_written_here(talk):
    bag = talk.save_bag("talk", begin=0.5)
    with AnyReader([Path(bag)], default_typestore=TYPES) as reader:
        rows = [(item.topic, moment, bytes(raw)) for item, moment, raw in reader.messages()]
        messages = [reader.deserialize(raw, item.msgtype) for item, _, raw in reader.messages()]
        qos = {item.topic: item.ext.offered_qos_profiles[0] for item in reader.connections}
    stored = [(channel.topic, m.log_time, m.data) for _, channel, m in Bag(Path(bag)).messages()]
    assert sorted(rows) == sorted(stored) and len(rows) == len(messages) > 20
    assert {topic for topic, *_ in rows} == {"/pose", "/text"}  # the latched one came before the recording
    assert (qos["/pose"].reliability.name, qos["/text"].reliability.name) == ("BEST_EFFORT", "RELIABLE")


def written(storage, epoch=LATER):
    """A bag that rosbags writes: twenty poses at 10 Hz and a latched text."""
    types = TYPES.types
    header, time = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
    point, turn = types["geometry_msgs/msg/Point"], types["geometry_msgs/msg/Quaternion"]
    pose = types["geometry_msgs/msg/Pose"](point(x=1.0, y=2.0, z=0.0), turn(x=0.0, y=0.0, z=0.0, w=1.0))
    folder = Path(f"from_{storage.name.lower()}")
    with Writer(folder, version=9, storage_plugin=storage) as writer:
        poses = writer.add_connection("/pose", "geometry_msgs/msg/PoseStamped", typestore=TYPES)
        names = writer.add_connection("/name", "std_msgs/msg/String", typestore=TYPES)
        text = types["std_msgs/msg/String"](data="from rosbags")
        writer.write(names, epoch, TYPES.serialize_cdr(text, "std_msgs/msg/String"))
        for number in range(20):
            moment = epoch + number * SECOND // 10
            stamp = time(sec=moment // SECOND, nanosec=moment % SECOND)
            message = types["geometry_msgs/msg/PoseStamped"](header(stamp=stamp, frame_id="map"), pose)
            writer.write(poses, moment, TYPES.serialize_cdr(message, "geometry_msgs/msg/PoseStamped"))
    return folder


@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_what_rosbags_writes_is_played_in_its_own_time(storage, capsys):
    bag = written(storage)
    found = run(Listener, bag=bag, quiet=True)
    poses = [row.message for row in found.messages("/pose")]
    assert [pose.pose.position.x for pose in poses] == [1.0] * 20
    ages = [now - LATER for topic, now in received(found) if topic == "/pose"]
    assert ages == [SECOND // 1000, *(number * SECOND // 10 for number in range(1, 20))]
    assert [row.message.data for row in found.messages("/name")] == ["from rosbags"]
    ros2(f"bag info {bag}")
    printed = capsys.readouterr().out
    assert f"Storage id:        {storage.name.lower()}" in printed and "Topic: /pose" in printed


def test_a_file_of_a_bag_is_a_bag(talk):
    bag = Path(talk.save_bag("talk"))
    found = run(Listener, bag=bag / "talk_0.mcap", quiet=True)
    assert len(received(found)) == Bag(bag).contents.counts.total()


def refused(bag, **more):
    with pytest.raises((BagError, ValueError, TypeError)) as caught:
        run(Listener, bag=bag, quiet=True, **more)
    return str(caught.value)


def test_what_is_wrong_with_a_bag_is_said_in_a_sentence(talk):
    bag = Path(talk.save_bag("talk"))
    assert refused("nowhere") == "Bag path 'nowhere' is not there."
    Path("empty").mkdir()
    assert refused("empty") == "Bag path 'empty' has no .mcap and no .db3 file."
    Path("empty/a.db3.zstd").touch()
    assert refused("empty").endswith("Decompress them first: `unzstd *.zstd` in that folder.")
    file = bag / "talk_0.mcap"
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    assert refused(bag) == (
        "talk/talk_0.mcap ends in the middle: its recorder was killed, or it was copied in part. Copy it "
        "again, or repair it with `mcap recover talk_0.mcap`."
    )
    file.write_bytes(b"no bag at all" * 100)
    assert refused(bag).startswith("talk/talk_0.mcap is not an MCAP file, or it is damaged (")
    Path("a.db3").write_bytes(b"no bag at all" * 100)
    assert refused("a.db3").endswith("in SQLite's format, or it is damaged (file is not a database).")
    assert refused("talk", world="room") == (
        "run() takes a world or a bag: what the robot does is in the bag already."
    )
    assert refused("talk", world=World.load("room")).startswith("run() takes a world or a bag")
    assert refused(7) == 'bag must be the path of a bag, such as "my_drive"; it is 7.'


def test_topics_of_types_that_are_not_installed_are_left_out_and_logged():
    bag = written(StoragePlugin.SQLITE3)
    with sqlite3.connect(bag / f"{bag.name}.db3") as base:
        base.execute("UPDATE topics SET type = 'my_robot/msg/Secret' WHERE name = '/name'")
    found = run(Listener, bag=bag, quiet=True)
    assert [line.text for line in found.logs if line.level == "WARN"] == [
        "Not played: /name, because my_robot/msg/Secret is not installed"
    ]
    assert len(found.messages("/pose")) == 20
    with sqlite3.connect(bag / f"{bag.name}.db3") as base:
        base.execute("UPDATE topics SET type = 'my_robot/msg/Secret'")
    assert refused(bag).startswith(f"Bag {bag} has no message that can be played (/name: my_robot/msg/Secr")


def test_one_topic_may_be_named_without_a_list_and_no_other_is_written(talk):
    counts = [Bag(Path(talk.save_bag("talk", topics))).contents.counts for topics in ("/text", ["/text"])]
    assert counts[0] == counts[1] and set(counts[0]) == {"/text"}
    with pytest.raises(BagError, match=r"^No message to write from 0 s on; topics"):
        talk.save_bag("talk", "/text/long")


def test_a_bag_without_messages_is_not_written_and_an_earlier_one_stays(talk):
    bag = Bag(Path(talk.save_bag("talk")))
    before = bag.contents.counts.total()
    for choice, begin in (({"topics": ["/txt"]}, "0"), ({"begin": 100.0}, "100")):
        with pytest.raises(BagError) as refused:
            talk.save_bag("talk", **choice)
        assert str(refused.value) == (
            f"No message to write from {begin} s on; topics with messages in this run: /name, /pose, /text."
        )
    assert bag.contents.counts.total() == before
