"""Formats transforms as messages, and frames as upstream prints them."""

from geometry_msgs.msg import TransformStamped

from tf2_py.cache import FrameCache, Nanoseconds, format_seconds
from tf2_py.errors import ConnectivityException
from tf2_py.rigid_transform import RigidTransform, normalized

SECOND = 10**9


def transform_message(
    stamp: Nanoseconds, target: str, source: str, transform: RigidTransform
) -> TransformStamped:
    """The message for a transform from the source frame to the target frame."""
    # Filled in place: passing nested messages to the constructor would first create others and discard them.
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = target, source
    header, translation, rotation = message.header, message.transform.translation, message.transform.rotation
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, SECOND)
    translation.x, translation.y, translation.z = transform.translation
    rotation.x, rotation.y, rotation.z, rotation.w = normalized(transform.rotation)
    return message


def connectivity_error(target: str, source: str) -> ConnectivityException:
    """The error for two frames that are not in the same tree."""
    return ConnectivityException(
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the "
        "same tree.Tf has two or more unconnected trees."
    )


def frame_yaml(name: str, authority: str, cache: FrameCache) -> str:
    """Upstream's YAML about a frame: parent, broadcaster, rate (Hz), times and buffer length (s)."""
    oldest, latest = cache.span
    rate = len(cache) * 1e9 / max(latest - oldest, 100_000)
    return (
        f"{name}: \n  parent: '{cache.latest.parent}'\n  broadcaster: '{authority}'\n  rate: {rate:.3f}\n"
        f"  most_recent_transform: {format_seconds(latest)}\n  oldest_transform: {format_seconds(oldest)}\n"
        f"  buffer_length: {(latest - oldest) / 1e9:.3f}\n"
    )
