"""A buffer of transforms: what is known of each frame, and the way from one frame to another."""

import threading
from collections.abc import Callable

from builtin_interfaces.msg import Time as Stamp
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.time import Time

from tf2_py.cache import Frame, Known, MovingFrame, Nanoseconds, StaticFrame, seconds
from tf2_py.errors import LookupException, TransformException
from tf2_py.frames import Frames, whole
from tf2_py.naming import check, without_slash
from tf2_py.rigid import STAY, Motion
from tf2_py.words import SECOND, faults, stamped, unconnected, yaml_of


class BufferCore:
    """Remembers transforms, and answers where one frame is in another.

    A time is an rclpy Time or a stamp of a message; 0 stands for the newest moment for which all is known.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        """cache_time: how far back moving frames are remembered; 10 s if it is left out."""
        self._length = cache_time.nanoseconds if cache_time is not None else 10 * SECOND
        self._frames = Frames()
        self._authorities: dict[str, str] = {}
        # The newest, since the last transform came: nodes ask for the same again and again.
        self._found: dict[tuple[str, str], tuple[Nanoseconds, Motion]] = {}
        self._lock = threading.RLock()

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Remember where a moving frame is; authority: who says so. What can't be is logged and left out."""
        self._set(transform, authority, MovingFrame)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Remember where a frame is for all times."""
        self._set(transform, authority, StaticFrame)

    def lookup_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Stamp
    ) -> TransformStamped:
        """The transform that takes what is given in source_frame into target_frame. It does not wait.

        Raises:
            TransformException: it can't be had; its kind and words tell why.
        """
        with self._lock:
            when, motion = self._lookup("lookupTransform", target_frame, source_frame, nanoseconds(time))
        return stamped(when, target_frame, source_frame, motion)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Stamp,
        source_frame: str,
        source_time: Time | Stamp,
        fixed_frame: str,
    ) -> TransformStamped:
        """From source_frame at one time to target_frame at another, while fixed_frame stood still."""
        asked = "lookupTransform"
        with self._lock:
            for role, frame in (("target", target_frame), ("source", source_frame), ("fixed", fixed_frame)):
                check(asked, f"{role}_frame", frame, self._frames)
            _, first = self._lookup(asked, fixed_frame, source_frame, nanoseconds(source_time))
            when, then = self._lookup(asked, target_frame, fixed_frame, nanoseconds(target_time))
        return stamped(when, target_frame, source_frame, then.after(first))

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Stamp
    ) -> tuple[bool, str]:
        """Whether lookup_transform_core would find it, and if not, why."""
        asked = "canTransform"
        with self._lock:
            return _tried(lambda: self._lookup(asked, target_frame, source_frame, nanoseconds(time)))

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Stamp,
        source_frame: str,
        source_time: Time | Stamp,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """Whether lookup_transform_full_core would find it, and if not, why."""
        asked = "canTransform"

        def both() -> None:
            for role, frame in (("target", target_frame), ("source", source_frame), ("fixed", fixed_frame)):
                check(asked, f"{role}_frame", frame, self._frames)
            self._lookup(asked, target_frame, fixed_frame, nanoseconds(target_time))
            self._lookup(asked, fixed_frame, source_frame, nanoseconds(source_time))

        with self._lock:
            return _tried(both)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """The newest time for which the whole way between two frames is known.

        Raises:
            TransformException: there is no such way.
        """
        with self._lock:
            for frame in (target_frame, source_frame):
                if frame not in self._frames:
                    raise LookupException(f"Frame {frame} does not exist.")
            return Time(nanoseconds=self._frames.common_time(target_frame, source_frame))

    def clear(self) -> None:
        """Forget all transforms of moving frames; the names and the static ones stay."""
        with self._lock:
            self._found.clear()
            for frame in self._frames.values():
                if frame is not None:
                    frame.clear()

    def all_frames_as_string(self) -> str:
        """Each frame and its parent, a line for each."""
        with self._lock:
            return self._frames.words()

    def all_frames_as_yaml(self) -> str:
        """Parent, broadcaster, rate (Hz), times and length of the memory (s) of each frame, as YAML."""
        with self._lock:
            known = [(name, frame) for name, frame in self._frames.items() if frame and frame.newest]
            texts = [yaml_of(name, self._authorities[name], frame) for name, frame in known]
            return "".join(texts) if self._frames else "[]"

    def _frameExists(self, frame_id: str) -> bool:
        return frame_id in self._frames

    def _getFrameStrings(self) -> list[str]:
        return list(self._frames)

    def _set(self, transform: TransformStamped, authority: str, kind: type[Frame]) -> None:
        parent, child = without_slash(transform.header.frame_id), without_slash(transform.child_frame_id)
        shift, turn = transform.transform.translation, transform.transform.rotation
        motion = Motion((turn.x, turn.y, turn.z, turn.w), (shift.x, shift.y, shift.z))
        wrong = faults(parent, child, motion, authority)
        for fault in wrong:
            get_logger("tf2").error(fault)
        if wrong:
            return
        with self._lock:
            self._found.clear()
            frame = self._frames.get(child)
            if not isinstance(frame, kind):
                frame = MovingFrame(self._length) if kind is MovingFrame else StaticFrame()
                self._frames[child] = frame
            self._frames.setdefault(parent, None)
            stamp = nanoseconds(transform.header.stamp)
            if frame.insert(Known(stamp, parent, motion)):
                self._authorities[child] = authority
            else:
                get_logger("tf2").warning(
                    f"TF_OLD_DATA ignoring data from the past for frame {child} at time {seconds(stamp)} "
                    f"according to authority {authority}\n"
                    "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained"
                )

    def _lookup(self, asked: str, target: str, source: str, time: Nanoseconds) -> tuple[Nanoseconds, Motion]:
        """The time that is meant, and the motion from the source into the target."""
        if time:
            return self._look_up(asked, target, source, time)
        if (target, source) not in self._found:
            self._found[target, source] = self._look_up(asked, target, source, time)
        return self._found[target, source]

    def _look_up(self, asked: str, target: str, source: str, time: Nanoseconds) -> tuple[Nanoseconds, Motion]:
        if target == source:
            frame = self._frames.get(target)
            return (frame.span[1] if frame is not None and time == 0 else time), STAY
        check(asked, "target_frame", target, self._frames)
        check(asked, "source_frame", source, self._frames)
        time = time or self._frames.common_time(target, source)
        top, up, broken = self._frames.climb(source, (target,), time)
        end, down, broken_below = self._frames.climb(target, (top, source), time)
        if end == source:  # found on the way: what is above it doesn't matter
            top, up = source, []
        where = f", when looking up transform from frame [{source}] to frame [{target}]"
        failed = broken_below or (broken if end != top else None)
        if failed is not None:
            raise type(failed)(f"{failed}{where}")
        if end != top:
            raise unconnected(target, source)
        return time, whole(down).inverse().after(whole(up))


def nanoseconds(time: Time | Stamp) -> Nanoseconds:
    """A time of rclpy or of a message as a whole number."""
    return time.nanoseconds if isinstance(time, Time) else time.sec * SECOND + time.nanosec


def _tried(attempt: Callable[[], object]) -> tuple[bool, str]:
    try:
        attempt()
    except TransformException as error:
        return False, str(error)
    return True, ""
