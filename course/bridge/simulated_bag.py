"""Writes the recording of a run as a bag, as if a laptop had recorded it over radio."""

import random
import shutil
from pathlib import Path

from rosbag2_py import ConverterOptions, SequentialWriter, StorageOptions, TopicMetadata

from sim import Recording

EPOCH = 1_735_689_600  # s: 1 January 2025, when runs begin
TOPICS = ("/cmd_vel", "/odom", "/scan")


def save_bag(recording: Recording, folder: str, delay: float = 0.03, jitter: float = 0.005) -> str:
    """Write /cmd_vel, /odom and /scan into a new folder; what the robot sends arrives after `delay` (s)."""
    shutil.rmtree(folder, ignore_errors=True)
    writer, chance = SequentialWriter(), random.Random(1)
    writer.open(StorageOptions(uri=folder, storage_id="mcap"), ConverterOptions("", ""))
    rows = []
    for number, topic in enumerate(TOPICS):
        messages = recording.messages(topic)
        kind = messages[0].type if messages else "geometry_msgs/msg/Twist"
        offered = [end.qos for end in recording.graph.publishers(topic)]
        reliability = 1 if offered and offered[0]["reliability"] == "reliable" else 2
        profile = {"reliability": reliability, "durability": 2, "history": 1, "depth": 10}
        writer.create_topic(TopicMetadata(number, topic, kind, "cdr", [profile]))
        late = [delay + chance.uniform(-jitter, jitter) if row.from_course else 0.0 for row in messages]
        rows += [(row.stamp + more, topic, row.raw) for row, more in zip(messages, late, strict=True)]
    for stamp, topic, raw in sorted(rows):
        writer.write(topic, raw, round((EPOCH + stamp) * 1e9))
    writer.close()
    return str(Path(folder))
