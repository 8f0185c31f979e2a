"""The QoS that a bag's topics were published with, as numbers or as names, as rosbag2 has written it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import yaml
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

RELIABILITIES, DURABILITIES = ("", "reliable", "best_effort"), ("", "transient_local", "volatile")
"""rmw's numbers of the policies are their indices."""
DEPTH = 10
LATCHED_DEPTH = 100  # as many as a bag may have of /tf_static, each of which is needed


INFINITE = {"sec": 9223372036, "nsec": 854775807}  # as rosbag2 writes a duration that isn't limited
KEEP_LAST, AUTOMATIC = 1, 1  # rmw's numbers


def recorded_qos(qos: Mapping[str, Any]) -> dict[str, Any]:
    """The QoS of an endpoint with all keys that rosbag2 writes. qos: as in `Endpoint.qos`."""
    return {
        "history": KEEP_LAST,
        "depth": qos.get("depth", DEPTH),
        "reliability": RELIABILITIES.index(qos.get("reliability", "reliable")),
        "durability": DURABILITIES.index(qos.get("durability", "volatile")),
        "deadline": dict(INFINITE),
        "lifespan": dict(INFINITE),
        "liveliness": AUTOMATIC,
        "liveliness_lease_duration": dict(INFINITE),
        "avoid_ros_namespace_conventions": False,
    }


def offered_profile(stored: Any) -> QoSProfile:
    """The profile to publish a topic with. stored: YAML, or the list that it describes; may be empty.

    Several publishers of a topic may have offered different profiles: the strongest of each policy matches
    each subscription that any of them matched.
    """
    profiles = _profiles(stored)
    reliable = _named(profiles, "reliability", RELIABILITIES)
    durable = _named(profiles, "durability", DURABILITIES)
    best_effort = reliable and "reliable" not in reliable
    latched = "transient_local" in durable
    return QoSProfile(
        depth=LATCHED_DEPTH if latched else DEPTH,
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _profiles(stored: Any) -> Sequence[Mapping[str, Any]]:
    try:
        found = yaml.safe_load(stored) if isinstance(stored, str) else stored
    except yaml.YAMLError:
        return []
    return [each for each in found if isinstance(each, Mapping)] if isinstance(found, list) else []


def _named(profiles: Sequence[Mapping[str, Any]], policy: str, names: Sequence[str]) -> set[str]:
    """The names of a policy's values in these profiles; without those that rmw doesn't know."""
    values = {profile.get(policy) for profile in profiles}
    numbers = {names[value] for value in values if isinstance(value, int) and 0 < value < len(names)}
    return numbers | {value for value in values if isinstance(value, str) and value in names}
