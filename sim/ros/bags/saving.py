"""Writes the recording of a run as a bag, as if a laptop had recorded it over radio."""

from __future__ import annotations

import random
import shutil
from collections.abc import Sequence
from pathlib import Path

from sim.evidence.rows import INFRASTRUCTURE_TOPICS, Seconds
from sim.evidence.run_data import RunData
from sim.nanoseconds import SECOND
from sim.ros.bags.bag_error import BagError
from sim.ros.bags.bag_files import BagWriter


def save_bag(
    recording: RunData,
    folder: str | Path,
    topics: str | Sequence[str] = (),
    *,
    delay: Seconds = 0.03,
    jitter: Seconds = 0.005,
    begin: Seconds = 0.0,
) -> str:
    """Write messages of a run into a folder, in place of an earlier bag; returns it.

    topics: which to write, one or several; without them all but ROS's own. delay: how long messages of the
    robot are on the way (s), more or less `jitter`. begin: when the recording begins (s): earlier messages
    are missing, and what was latched earlier, too. Raises BagError if the folder can't be made, or if there
    is no message.
    """
    chance, rows = random.Random(1), []
    wanted = {topics} if isinstance(topics, str) and topics else set(topics)
    for row in recording.published:
        late = max(0.0, delay + chance.uniform(-jitter, jitter)) if row.from_course else 0.0
        if (not wanted or row.topic in wanted) and row.topic not in INFRASTRUCTURE_TOPICS:
            rows.append((row.stamp + late, row))
    rows = [(received, row) for received, row in rows if received >= begin]
    if not rows:
        there = ", ".join(sorted({row.topic for row in recording.published} - INFRASTRUCTURE_TOPICS))
        raise BagError(
            f"No message to write from {begin:g} s on; topics with messages in this run: {there or 'none'}."
        )
    if Path(folder, "metadata.yaml").is_file():
        shutil.rmtree(folder)  # an earlier bag; BagWriter refuses any other folder
    qos = {end.name: end.qos for end in recording.graph.publishers()}
    with BagWriter(Path(folder)) as writer:
        for received, row in sorted(rows, key=lambda pair: pair[0]):
            times = (recording.epoch + round(moment * SECOND) for moment in (received, row.stamp))
            writer.write(row.topic, row.type, row.raw, tuple(times), qos.get(row.topic, {}))
    return str(Path(folder))
