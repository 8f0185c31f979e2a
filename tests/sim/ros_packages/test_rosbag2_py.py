"""Bags that a run's nodes, or `ros2 bag`, write and read."""

import sqlite3
from pathlib import Path

import pytest
import rosbag2_py
from rclpy.node import Node
from rclpy.serialization import serialize_message
from std_msgs.msg import String

from sim import executable, run
from sim.ros.bags.bag_files import Bag
from sim.ros2.notebook import ros2
from tests.ros_packages.test_rosbag2_py import SECOND, opened_reader, refused, texts, topic, write


def test_ros2_bag_reads_it_and_the_other_way_round(tmp_path):
    folder = write(tmp_path / "bag")
    assert "Topic: /chatter | Type: std_msgs/msg/String | Count: 5" in Bag(folder).info()
    (folder / "metadata.yaml").unlink()
    for path in (folder, folder / "bag_0.mcap"):
        reader = rosbag2_py.SequentialReader()
        reader.open_uri(str(path))
        assert reader.get_metadata().message_count == 10
        assert reader.get_metadata().duration.nanoseconds == 4 * SECOND + 1
        assert texts(reader) == ["1", "2", "3", "4", "5"]


class Recorder(Node):
    """The recorder of the official tutorial, which never closes its bag."""

    def __init__(self):
        super().__init__("simple_bag_recorder")
        self.writer = rosbag2_py.SequentialWriter()
        self.writer.open(
            rosbag2_py.StorageOptions(uri="my_bag", storage_id="mcap"), rosbag2_py.ConverterOptions("", "")
        )
        self.writer.create_topic(topic("chatter"))
        self.create_subscription(String, "chatter", self.on_text, 10)

    def on_text(self, message):
        self.writer.write("chatter", serialize_message(message), self.get_clock().now().nanoseconds)


def test_a_node_records_in_a_run_and_its_bag_is_whole_afterwards(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    recording = run(executable("demo_nodes_py", "talker"), Recorder, seconds=3.5, quiet=True)
    assert recording.errors == []
    assert texts(opened_reader("my_bag")) == [f"Hello World: {number}" for number in range(3)]


def test_what_ros2_bag_recorded_is_read(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    recording = run(executable("demo_nodes_py", "talker"), seconds=2.5, quiet=True)
    assert recording.errors == []
    ros2("bag record -o recorded /chatter")
    assert texts(opened_reader("recorded")) == ["Hello World: 0", "Hello World: 1"]


@pytest.mark.parametrize("storage_id", ["", "mcap", "sqlite3"])
def test_a_bag_in_sqlite_is_refused_with_a_remedy(tmp_path, monkeypatch, capsys, storage_id):
    monkeypatch.chdir(tmp_path)
    file = Path("old/old_0.db3")
    file.parent.mkdir()
    sqlite3.connect(file).close()
    Path("old/metadata.yaml").write_text("rosbag2_bagfile_information: {storage_identifier: sqlite3}")
    for path in file.parent, file:
        sentence = (
            f"{path} is a bag in SQLite's format, and only bags in 'mcap' can be read here. Convert it where "
            f"ROS is installed: `ros2 bag convert -i {path} -o out.yaml`, with `output_bags: [{{uri: "
            "new_bag, storage_id: mcap, all: true}]` in out.yaml."
        )
        storage = rosbag2_py.StorageOptions(str(path), storage_id), rosbag2_py.ConverterOptions()
        assert refused(rosbag2_py.SequentialReader().open, *storage) == sentence
        ros2(f"bag info {path}")
        assert capsys.readouterr().out == (
            f"{file} is not a bag in SQLite's format, or it is damaged (no such table: topics).\n"
        )
