"""Bags that programs write and read with rosbag2_py, as in the official tutorials."""

import os
import shutil
from pathlib import Path

import pytest
import rosbag2_py
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_runtime_py.utilities import get_action, get_interface, get_message, get_service
from std_msgs.msg import String
from std_srvs.srv import Trigger

SECOND = 1_000_000_000


def topic(name: str = "/chatter", type_: str = "std_msgs/msg/String") -> rosbag2_py.TopicMetadata:
    return rosbag2_py.TopicMetadata(id=0, name=name, type=type_, serialization_format="cdr")


def opened_writer(folder, **options) -> rosbag2_py.SequentialWriter:
    writer = rosbag2_py.SequentialWriter()
    writer.open(
        rosbag2_py.StorageOptions(uri=str(folder), storage_id="mcap", **options),
        rosbag2_py.ConverterOptions("", ""),
    )
    return writer


def opened_reader(path) -> rosbag2_py.SequentialReader:
    reader = rosbag2_py.SequentialReader()
    reader.open(rosbag2_py.StorageOptions(uri=str(path)), rosbag2_py.ConverterOptions("cdr", "cdr"))
    return reader


def write(folder, count: int = 5, **options) -> Path:
    """A bag with texts and velocities, each second."""
    writer = opened_writer(folder, **options)
    writer.create_topic(topic())
    writer.create_topic(topic("/cmd_vel", "geometry_msgs/msg/Twist"))
    for second in range(1, count + 1):
        writer.write("/chatter", serialize_message(String(data=f"{second}")), second * SECOND)
        writer.write("/cmd_vel", serialize_message(Twist()), second * SECOND + 1, second * SECOND)
    del writer
    return folder


def rest(reader) -> list[tuple[str, int]]:
    """The topics and stamps of the messages that follow."""
    found = []
    while reader.has_next():
        name, _, stamp = reader.read_next()
        found.append((name, stamp))
    return found


def texts(reader) -> list[str]:
    types = {each.name: each.type for each in reader.get_all_topics_and_types()}
    found = []
    while reader.has_next():
        name, data, _ = reader.read_next()
        message = deserialize_message(data, get_message(types[name]))
        if isinstance(message, String):
            found.append(message.data)
    return found


def test_what_was_written_is_read_again(tmp_path):
    reader = opened_reader(write(tmp_path / "bag"))
    assert texts(reader) == ["1", "2", "3", "4", "5"]
    with pytest.raises(RuntimeError, match=r"^Bag is at end\. No next message\.$"):
        reader.read_next()
    assert [(each.id, each.name, each.type) for each in reader.get_all_topics_and_types()] == [
        (1, "/chatter", "std_msgs/msg/String"),
        (2, "/cmd_vel", "geometry_msgs/msg/Twist"),
    ]
    definitions = {each.topic_type: each for each in reader.get_all_message_definitions()}
    assert definitions["std_msgs/msg/String"].encoding == "ros2msg"
    assert "MSG: geometry_msgs/Vector3" in definitions["geometry_msgs/msg/Twist"].encoded_message_definition


def test_its_metadata_is_that_of_a_bag(tmp_path):
    folder = write(tmp_path / "bag")
    metadata = rosbag2_py.Info().read_metadata(str(folder), "mcap")
    assert (metadata.version, metadata.storage_identifier, metadata.message_count) == (9, "mcap", 10)
    assert metadata.starting_time.nanoseconds == SECOND
    assert metadata.duration.nanoseconds == 4 * SECOND + 1
    assert metadata.bag_size == sum(path.stat().st_size for path in folder.iterdir())
    assert opened_reader(folder).get_metadata() == metadata
    text = rosbag2_py.MetadataIo().serialize_metadata(metadata)
    metadata.bag_size = 0
    assert rosbag2_py.MetadataIo().deserialize_metadata(text) == metadata


def test_a_filter_and_a_moment_select_what_follows(tmp_path):
    reader = opened_reader(write(tmp_path / "bag"))
    reader.seek(3 * SECOND + 1)
    assert reader.read_next()[0] == "/cmd_vel"
    reader.set_filter(rosbag2_py.StorageFilter(topics=["/chatter"]))
    assert rest(reader) == [("/chatter", 4 * SECOND), ("/chatter", 5 * SECOND)]
    reader.seek(5 * SECOND)  # the filter stays
    assert rest(reader) == [("/chatter", 5 * SECOND)]
    for filter_, count in (
        (rosbag2_py.StorageFilter(regex="/c.*"), 10),
        (rosbag2_py.StorageFilter(regex="/chat"), 0),
        (rosbag2_py.StorageFilter(exclude_topics=["/chatter"]), 5),
        (rosbag2_py.StorageFilter(regex_to_exclude=".*vel"), 5),
    ):
        reader.set_filter(filter_)
        reader.seek(0)
        assert len(rest(reader)) == count
    reader.reset_filter()
    reader.seek(0)
    assert len(rest(reader)) == 10


def test_messages_are_read_forwards_or_backwards(tmp_path):
    reader = opened_reader(write(tmp_path / "bag", max_bagfile_duration=2))
    by = rosbag2_py.ReadOrderSortBy
    assert not reader.set_read_order(rosbag2_py.ReadOrder(by.PublishedTimestamp))
    assert not reader.set_read_order(rosbag2_py.ReadOrder(by.File, reverse=True))
    assert reader.set_read_order(rosbag2_py.ReadOrder(by.File))
    forwards = rest(reader)
    assert reader.set_read_order(rosbag2_py.ReadOrder(reverse=True))
    assert rest(reader) == forwards[::-1]
    reader.seek(2 * SECOND)
    assert rest(reader) == [("/chatter", 2 * SECOND), ("/cmd_vel", SECOND + 1), ("/chatter", SECOND)]


def test_a_bag_has_several_files_if_the_options_or_the_program_say_so(tmp_path):
    files = [
        rosbag2_py.Info().read_metadata(str(write(tmp_path / name, **options)), "mcap").relative_file_paths
        for name, options in (("a", {"max_bagfile_duration": 2}), ("b", {"max_bagfile_size": 200}))
    ]
    assert files == [["a_0.mcap", "a_1.mcap"], ["b_0.mcap", "b_1.mcap"]]
    writer = opened_writer(tmp_path / "c")
    writer.split_bagfile()
    writer.close()
    writer.close()
    assert [each.message_count for each in opened_reader(tmp_path / "c").get_metadata().files] == [0, 0]


def test_messages_outside_the_given_time_are_left_out(tmp_path):
    folder = write(tmp_path / "bag", start_time_ns=2 * SECOND, end_time_ns=3 * SECOND)
    assert texts(opened_reader(folder)) == ["2", "3"]


def test_a_writer_whose_folder_is_gone_ends_silently(tmp_path, capfd):
    writer = opened_writer(tmp_path / "bag")
    shutil.rmtree(tmp_path / "bag")
    del writer
    assert capfd.readouterr() == ("", "")


def refused(function, *arguments) -> str:
    with pytest.raises(RuntimeError) as caught:
        function(*arguments)
    return str(caught.value)


def test_what_is_used_before_it_is_open_is_refused():
    reader, writer = rosbag2_py.SequentialReader(), rosbag2_py.SequentialWriter()
    not_open = "Bag is not open. Call open() before "
    assert refused(reader.has_next) == refused(reader.get_metadata) == f"{not_open}reading."
    assert refused(reader.set_filter, rosbag2_py.StorageFilter()) == f"{not_open}setting filter."
    assert refused(reader.seek, 0) == f"{not_open}seeking time."
    order = rosbag2_py.ReadOrder()
    assert refused(reader.set_read_order, order) == "read order can only be set after open()"
    assert refused(writer.create_topic, topic()) == f"{not_open}writing."
    assert refused(writer.remove_topic, topic()) == f"{not_open}removing."
    assert refused(writer.write, "/chatter", b"", 0) == f"{not_open}writing."
    assert not writer.take_snapshot()


def test_what_cannot_be_written_is_refused(tmp_path):
    write(tmp_path / "bag")
    exists = f"Bag directory already exists ({tmp_path}/bag), can't overwrite existing bag"
    assert refused(opened_writer, tmp_path / "bag") == exists
    below = tmp_path / "bag" / "bag_0.mcap" / "more"
    assert refused(opened_writer, below) == f"Failed to create bag directory ({below})."
    snapshot = "Snapshot mode is not supported here: write all messages."
    assert refused(lambda: opened_writer(tmp_path / "x", snapshot_mode=True)) == snapshot
    writer = opened_writer(tmp_path / "y")
    writer.open(rosbag2_py.StorageOptions("elsewhere"), rosbag2_py.ConverterOptions())  # it is open already
    missing = "Failed to write on topic '/chatter'. Call create_topic() before first write."
    assert refused(writer.write, "/chatter", b"", 0) == missing
    unknown = 'Failed to remove the non-existing topic "/chatter"!'
    assert refused(writer.remove_topic, topic()) == unknown
    writer.create_topic(topic())
    writer.remove_topic(topic())


def test_what_cannot_be_read_is_refused(tmp_path):
    nothing = "No storage could be initialized from the inputs."
    assert refused(opened_reader, tmp_path) == refused(opened_reader, tmp_path / "no.mcap") == nothing
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: 1")
    assert refused(opened_reader, tmp_path).startswith("Exception on parsing info file: ")
    (tmp_path / "broken.mcap").write_bytes(os.urandom(100))
    broken = refused(opened_reader, tmp_path / "broken.mcap")
    assert broken.startswith(f"{tmp_path}/broken.mcap is not an MCAP file, or it is damaged: ")
    missing = refused(rosbag2_py.Info().read_metadata, "nowhere", "mcap")
    assert missing == "Exception on parsing info file: No such file or directory"


def test_other_storages_and_formats_are_refused():
    reader = rosbag2_py.SequentialReader()
    storage = rosbag2_py.StorageOptions("bag", "sqlite3"), rosbag2_py.ConverterOptions()
    for end in reader, rosbag2_py.SequentialWriter():
        assert refused(end.open, *storage) == (
            "No storage could be initialized: storage_id is 'sqlite3', and only 'mcap' is supported here. "
            "Pass storage_id='mcap'."
        )
    formats = rosbag2_py.StorageOptions("bag"), rosbag2_py.ConverterOptions("cdr", "json")
    assert refused(reader.open, *formats) == "Messages are 'cdr', and can't be converted to or from 'json'."
    assert rosbag2_py.get_default_storage_id() == "mcap"
    assert rosbag2_py.get_registered_readers() == rosbag2_py.get_registered_writers() == {"mcap"}
    assert rosbag2_py.get_registered_serializers() == set()


def test_types_are_found_by_their_names():
    assert get_message("std_msgs/msg/String") is get_interface("std_msgs/msg/String") is String
    assert get_service("std_srvs/srv/Trigger") is Trigger
    assert get_action("example_interfaces/action/Fibonacci") is Fibonacci


@pytest.mark.parametrize(
    ("function", "name", "text"),
    [
        (get_message, "String", "Expected the full name of an interface, got 'String'"),
        (get_message, "std_srvs/srv/Empty", "Expected the full name of a message, got 'std_srvs/srv/Empty'"),
        (get_service, "std_msgs/msg/Bool", "Expected the full name of a service, got 'std_msgs/msg/Bool'"),
        (get_action, "std_msgs/msg/Bool", "Expected the full name of an action, got 'std_msgs/msg/Bool'"),
    ],
)
def test_another_kind_of_name_is_refused(function, name, text):
    with pytest.raises(ValueError, match=f"^{text}$"):
        function(name)


def test_names_are_also_in_the_module_that_the_tutorials_use():
    assert rosbag2_py._storage.StorageOptions is rosbag2_py.StorageOptions
    assert rosbag2_py._storage.ConverterOptions("", "").input_serialization_format == ""
    assert rosbag2_py._storage.TopicMetadata is rosbag2_py.TopicMetadata
