"""The options of ros2 that choose a quality of service."""

from __future__ import annotations

import copy
from argparse import Namespace

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

from sim.ros2.group import argument

POLICIES = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}
QOS = (
    argument(
        "--qos-profile",
        choices=QoSPresetProfiles.short_keys(),
        help="Quality of service preset profile",
    ),
    argument("--qos-depth", metavar="N", type=int, help="Queue size (overrides depth of --qos-profile)"),
    *(
        argument(f"--qos-{name}", choices=kind.short_keys(), help=f"Overrides {name} of --qos-profile")
        for name, kind in POLICIES.items()
    ),
    argument(
        "--qos-liveliness-lease-duration-seconds",
        type=float,
        metavar="N",
        help="Overrides the liveliness lease duration of --qos-profile",
    ),
)


def asked_profile(asked: Namespace, default: str) -> QoSProfile | None:
    """The profile that the options ask for; None where none of them is given. default: a preset's name."""
    chosen = {name: getattr(asked, f"qos_{name}") for name in POLICIES}
    lease = asked.qos_liveliness_lease_duration_seconds
    if not any((asked.qos_profile, asked.qos_depth, lease, *chosen.values())):
        return None
    profile = copy.copy(QoSPresetProfiles.get_from_short_key(asked.qos_profile or default))
    for name, word in chosen.items():
        if word:
            setattr(profile, name, POLICIES[name].get_from_short_key(word))
    if asked.qos_depth is not None:
        profile.depth = asked.qos_depth
    if lease:
        profile.liveliness_lease_duration = Duration(seconds=lease)
    if profile.durability is DurabilityPolicy.TRANSIENT_LOCAL and not profile.depth:
        profile.depth = 1
    return profile
