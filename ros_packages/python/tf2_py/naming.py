"""Names of frames: which can't be any, and in which words that is said."""

from collections.abc import Container

from tf2_py.errors import InvalidArgumentException, LookupException


def without_slash(frame: str) -> str:
    """The name without the slash that names in ROS 1 began with."""
    return frame.removeprefix("/")


def check(function: str, argument: str, frame: str, known: Container[str]) -> None:
    """Refuse what can't be the name of a frame, or is not known.

    function: lookupTransform or canTransform, which have words of their own.

    Raises:
        InvalidArgumentException: the name is empty or begins with a slash.
        LookupException: there is no such frame.
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
