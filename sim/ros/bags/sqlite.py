"""Reads bags in SQLite's format, which was the default of ROS 2 until Humble."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from mcap.records import Channel, Message, Schema

from sim.ros.bags.bag_error import BagError

QOS = "offered_qos_profiles"
"""Key of a topic's QoS in a channel's metadata, and the column of the table `topics`."""
SqliteRow = tuple[Schema, Channel, Message]


def read_sqlite(file: Path) -> Iterator[SqliteRow]:
    """Schema, channel and message as a bag in MCAP has them, in the order of their reception.

    Raises BagError for a file that isn't a bag.
    """
    address = f"{file.resolve().as_uri()}?mode=ro&immutable=1"  # no files appear beside it
    try:
        with closing(sqlite3.connect(address, uri=True)) as base:
            channels = _channels(base)
            rows = base.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id")
            for number, (topic, moment, data) in enumerate(rows):
                schema, channel = channels[topic]
                message = Message(channel.id, moment, bytes(data), moment, number)
                yield schema, channel, message
    except (sqlite3.Error, KeyError) as error:
        raise BagError(f"{file} is not a bag in SQLite's format, or it is damaged ({error}).") from None


def _channels(base: sqlite3.Connection) -> dict[int, tuple[Schema, Channel]]:
    """The topics by their ids. The first bags of ROS 2 don't have their QoS."""
    columns = [row[1] for row in base.execute("PRAGMA table_info(topics)")]
    qos = QOS if QOS in columns else "''"
    rows = base.execute(f"SELECT id, name, type, serialization_format, {qos} FROM topics")
    return {
        number: (
            Schema(data=b"", encoding="", id=number, name=type_),
            Channel(id=number, topic=name, message_encoding=format_, metadata={QOS: text}, schema_id=number),
        )
        for number, name, type_, format_, text in rows
    }
