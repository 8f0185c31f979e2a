"""What goes out: transforms as messages, and faults and frames in upstream's words."""

import math

from builtin_interfaces.msg import Time as Stamp
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from std_msgs.msg import Header

from tf2_py.cache import Frame, Nanoseconds, seconds
from tf2_py.errors import ConnectivityException
from tf2_py.rigid import Motion, normalised

SECOND = 10**9
TOLERANCE = 10e-3  # of a quaternion's squared length


def stamped(when: Nanoseconds, target: str, source: str, motion: Motion) -> TransformStamped:
    """The message for a motion from the source's frame into the target's."""
    sec, nanosec = divmod(when, SECOND)
    x, y, z, w = normalised(motion.rotation)
    return TransformStamped(
        header=Header(frame_id=target, stamp=Stamp(sec=sec, nanosec=nanosec)),
        child_frame_id=source,
        transform=Transform(
            translation=Vector3(**dict(zip("xyz", motion.shift, strict=True))),
            rotation=Quaternion(x=x, y=y, z=z, w=w),
        ),
    )


def unconnected(target: str, source: str) -> ConnectivityException:
    """The error for two frames between which no way leads."""
    return ConnectivityException(
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the "
        "same tree.Tf has two or more unconnected trees."
    )


def faults(parent: str, child: str, motion: Motion, authority: str) -> list[str]:
    """What makes a transform useless, in upstream's words."""
    found = []
    if child == parent:
        found.append(
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and  '
            f'child_frame_id "{child}" because they are the same'
        )
    if not child:
        found.append(
            f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" '
            "because child_frame_id not set "
        )
    if not parent:
        found.append(
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority "{authority}" '
            "because frame_id not set"
        )
    turn = " ".join(f"{part:f}" for part in motion.rotation)
    shift = " ".join(f"{part:f}" for part in motion.shift)
    if any(math.isnan(part) for part in (*motion.shift, *motion.rotation)):
        found.append(
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
            f"because of a nan value in the transform ({shift}) ({turn})"
        )
    if not abs(sum(part * part for part in motion.rotation) - 1.0) < TOLERANCE:
        found.append(
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of an invalid quaternion in the transform ({turn})'
        )
    return found


def yaml_of(name: str, authority: str, frame: Frame) -> str:
    """What is known of a frame, as upstream's YAML says it."""
    oldest, newest = frame.span
    rate = len(frame) * 1e9 / max(newest - oldest, 100_000)
    return (
        f"{name}: \n  parent: '{frame.newest.parent}'\n  broadcaster: '{authority}'\n  rate: {rate:.3f}\n"
        f"  most_recent_transform: {seconds(newest)}\n  oldest_transform: {seconds(oldest)}\n"
        f"  buffer_length: {(newest - oldest) / 1e9:.3f}\n"
    )
