"""What goes out: transforms as messages, and faults and frames in upstream's words."""

import math

from geometry_msgs.msg import TransformStamped

from tf2_py.cache import Frame, Nanoseconds, seconds
from tf2_py.errors import ConnectivityException
from tf2_py.rigid import Motion, normalised

SECOND = 10**9
TOLERANCE = 10e-3  # of a quaternion's squared length


def stamped(when: Nanoseconds, target: str, source: str, motion: Motion) -> TransformStamped:
    """The message for a motion from the source's frame into the target's."""
    # Filled in place: a message that is given its parts makes others first, which are thrown away.
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = target, source
    stamp, shift, turn = message.header.stamp, message.transform.translation, message.transform.rotation
    stamp.sec, stamp.nanosec = divmod(when, SECOND)
    shift.x, shift.y, shift.z = motion.shift
    turn.x, turn.y, turn.z, turn.w = normalised(motion.rotation)
    return message


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
    x, y, z, w = motion.rotation
    if any(map(math.isnan, (*motion.shift, *motion.rotation))):
        found.append(
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
            "because of a nan value in the transform "
            f"({_numbers(motion.shift)}) ({_numbers(motion.rotation)})"
        )
    if not abs(x * x + y * y + z * z + w * w - 1.0) < TOLERANCE:
        found.append(
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of an invalid quaternion in the transform ({_numbers(motion.rotation)})'
        )
    return found


def _numbers(parts: tuple[float, ...]) -> str:
    return " ".join(f"{part:f}" for part in parts)


def yaml_of(name: str, authority: str, frame: Frame) -> str:
    """What is known of a frame, as upstream's YAML says it."""
    oldest, newest = frame.span
    rate = len(frame) * 1e9 / max(newest - oldest, 100_000)
    return (
        f"{name}: \n  parent: '{frame.newest.parent}'\n  broadcaster: '{authority}'\n  rate: {rate:.3f}\n"
        f"  most_recent_transform: {seconds(newest)}\n  oldest_transform: {seconds(oldest)}\n"
        f"  buffer_length: {(newest - oldest) / 1e9:.3f}\n"
    )
