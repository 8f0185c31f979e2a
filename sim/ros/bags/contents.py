"""The contents of a bag, as its metadata.yaml describes them and `ros2 bag info` prints them."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sim.distro import DISTRO
from sim.nanoseconds import SECOND, Nanoseconds

VERSION = 8  # of metadata.yaml
MCAP, SQLITE = "mcap", "sqlite3"  # formats, as `ros2 bag` names them
EVENTS, EVENT_TYPE = "/_service_event", "_Event"  # how the topic and the type of a service's events end


def is_service_event(topic: str, type_: str) -> bool:
    """Return whether a topic carries the events of a service."""
    return topic.endswith(EVENTS) and "/srv/" in type_ and type_.endswith(EVENT_TYPE)


@dataclass
class Contents:
    """The number of a bag's messages by topic, and from when to when, in nanoseconds since 1970."""

    counts: Counter[str] = field(default_factory=Counter)
    types: dict[str, str] = field(default_factory=dict)
    qos: dict[str, str] = field(default_factory=dict)  # YAML, of the topics that have it
    begin: Nanoseconds = 0
    end: Nanoseconds = 0

    def add(self, topic: str, type_: str, received: Nanoseconds, qos: str = "") -> None:
        """Count a message. qos: of its topic, as YAML."""
        first = not self.counts
        self.begin = received if first else min(self.begin, received)
        self.end = received if first else max(self.end, received)
        self.counts[topic] += 1
        self.types[topic] = type_
        self.qos[topic] = qos

    @property
    def topics(self) -> list[str]:
        """Its topics, sorted, without those that carry events of services."""
        return [name for name in sorted(self.counts) if not is_service_event(name, self.types[name])]

    def metadata(self, files: Sequence[Path]) -> dict[str, Any]:
        """The content of metadata.yaml."""
        topics = [
            {
                "topic_metadata": {
                    "name": name,
                    "type": self.types[name],
                    "serialization_format": "cdr",
                    "offered_qos_profiles": self.qos.get(name, ""),
                    "type_description_hash": "",
                },
                "message_count": count,
            }
            for name, count in sorted(self.counts.items())
        ]
        return {
            "rosbag2_bagfile_information": {
                "version": VERSION,
                "storage_identifier": MCAP,
                **self._span(),
                "topics_with_message_count": topics,
                "compression_format": "",
                "compression_mode": "",
                "relative_file_paths": [file.name for file in files],
                "files": [{"path": file.name, **self._span()} for file in files],
                "custom_data": None,
                "ros_distro": DISTRO,
            }
        }

    def _span(self) -> dict[str, Any]:
        """Always new dictionaries: YAML would refer to the same ones by anchors."""
        return {
            "duration": {"nanoseconds": self.end - self.begin},
            "starting_time": {"nanoseconds_since_epoch": self.begin},
            "message_count": self.counts.total(),
        }

    def info(self, files: Sequence[Path], storage: str = MCAP) -> str:
        """A summary, as `ros2 bag info` prints it."""
        services = [name for name in sorted(self.counts) if name not in self.topics]
        topics = [
            f"Topic: {name} | Type: {self.types[name]} | Count: {self.counts[name]} | "
            "Serialization Format: cdr"
            for name in self.topics
        ]
        events = [
            f"Service: {name.removesuffix(EVENTS)} | Type: {self.types[name].removesuffix(EVENT_TYPE)} | "
            f"Event Count: {self.counts[name]} | Serialization Format: cdr"
            for name in services
        ]
        rows = {
            "Files": ("\n" + 19 * " ").join(file.name for file in files),
            "Bag size": _size(sum(file.stat().st_size for file in files)),
            "Storage id": storage,
            "ROS Distro": DISTRO,
            "Duration": f"{_seconds(self.end - self.begin)}s",
            "Start": _date(self.begin),
            "End": _date(self.end),
            "Messages": self.counts.total() - sum(self.counts[name] for name in services),
            "Topic information": ("\n" + 19 * " ").join(topics),
            "Service": len(services),
        }
        lines = [f"{name + ':':19}{value}" for name, value in rows.items()]
        return "\n".join(["", *lines, "Service information: " + ("\n" + 21 * " ").join(events)])


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds // SECOND}.{nanoseconds % SECOND:09}"


def _date(nanoseconds: int) -> str:
    local = time.localtime(nanoseconds // SECOND)
    clock = time.strftime("%b %e %Y %H:%M:%S", local)
    return f"{clock}.{nanoseconds % SECOND:09} ({_seconds(nanoseconds)})"


def _size(number: float) -> str:
    units = ["B", "KiB", "MiB", "GiB"]
    while number >= 1024 and len(units) > 1:
        number /= 1024
        del units[0]
    return f"{number:.0f} B" if units[0] == "B" else f"{number:.1f} {units[0]}"
