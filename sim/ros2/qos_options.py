"""The ros2 options that select a QoS profile."""

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


def profile_from_options(options: Namespace, default: str) -> QoSProfile | None:
    """The profile selected by the options; None if no such option is given. default: a preset's name."""
    chosen = {name: getattr(options, f"qos_{name}") for name in POLICIES}
    lease = options.qos_liveliness_lease_duration_seconds
    if not any((options.qos_profile, options.qos_depth, lease, *chosen.values())):
        return None
    profile: QoSProfile = copy.copy(QoSPresetProfiles.get_from_short_key(options.qos_profile or default))
    for name, value in chosen.items():
        if value:
            setattr(profile, name, POLICIES[name].get_from_short_key(value))
    if options.qos_depth is not None:
        profile.depth = options.qos_depth
    if lease:
        profile.liveliness_lease_duration = Duration(seconds=lease)
    if profile.durability is DurabilityPolicy.TRANSIENT_LOCAL and not profile.depth:
        profile.depth = 1
    return profile
