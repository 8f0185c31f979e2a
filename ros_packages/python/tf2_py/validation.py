"""Checks frame ids and transforms; the messages are upstream's."""

import math
from collections.abc import Container

from tf2_py.errors import InvalidArgumentException, LookupException
from tf2_py.rigid_transform import RigidTransform

QUATERNION_TOLERANCE = 10e-3  # of the squared length


def strip_slash(frame: str) -> str:
    """A frame id without the leading slash of ROS 1."""
    return frame.removeprefix("/")


def check_frame_id(function: str, argument: str, frame: str, known: Container[str]) -> None:
    """Check that a frame id is valid and known.

    function: lookupTransform or canTransform, whose messages differ.

    Raises:
        InvalidArgumentException: the frame id is empty or begins with a slash.
        LookupException: the frame does not exist.
    """
    if frame in known and frame and not frame.startswith("/"):
        return
    place = f"passed to {function} argument {argument}"
    lookup = function == "lookupTransform"
    begin = f'Invalid argument "{frame}" {place}' if lookup else f'Invalid frame ID "{frame}" {place}'
    if not frame:
        raise InvalidArgumentException(f"{begin} - in tf2 frame_ids cannot be empty")
    if frame.startswith("/"):
        raise InvalidArgumentException(f"{begin} - in tf2 frame_ids cannot start with a '/'")
    if frame not in known:
        unknown = f'"{frame}" {place} does not exist. ' if lookup else f"{begin} - frame does not exist"
        raise LookupException(unknown)


def transform_errors(parent: str, child: str, transform: RigidTransform, authority: str) -> list[str]:
    """The reasons why a transform is ignored; empty if it is valid."""
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
    x, y, z, w = transform.rotation
    if any(map(math.isnan, (*transform.translation, *transform.rotation))):
        found.append(
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
            "because of a nan value in the transform "
            f"({_numbers(transform.translation)}) ({_numbers(transform.rotation)})"
        )
    if not abs(x * x + y * y + z * z + w * w - 1.0) < QUATERNION_TOLERANCE:
        found.append(
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of an invalid quaternion in the transform '
            f"({_numbers(transform.rotation)})"
        )
    return found


def _numbers(values: tuple[float, ...]) -> str:
    return " ".join(f"{value:f}" for value in values)
