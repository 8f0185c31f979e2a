"""The buffer of transforms: stores the transforms of all frames and composes them."""

import threading
from collections.abc import Callable

from builtin_interfaces.msg import Time as Stamp
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.time import Time

from tf2_py.cache import FrameCache, Nanoseconds, StaticCache, StoredTransform, TimeCache, format_seconds
from tf2_py.errors import LookupException, TransformException
from tf2_py.formatting import SECOND, connectivity_error, frame_yaml, transform_message
from tf2_py.frames import Frames, compose
from tf2_py.rigid_transform import IDENTITY, RigidTransform
from tf2_py.validation import check_frame_id, strip_slash, transform_errors


class BufferCore:
    """Stores transforms, and looks up the transform between any two frames.

    A time is an rclpy Time or a message's stamp. Time 0 is the latest time at which all is available.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        """cache_time: how long transforms of moving frames are stored; 10 s by default."""
        self._cache_time = cache_time.nanoseconds if cache_time is not None else 10 * SECOND
        self._frames = Frames()
        self._authorities: dict[str, str] = {}
        # The results of lookups at time 0 since the last change: nodes repeat their lookups.
        self._latest: dict[tuple[str, str], tuple[Nanoseconds, RigidTransform]] = {}
        self._lock = threading.RLock()

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Store a transform of a moving frame; log an invalid one. authority: the publisher's name."""
        self._set(transform, authority, TimeCache)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Store a transform that is valid at any time."""
        self._set(transform, authority, StaticCache)

    def lookup_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Stamp
    ) -> TransformStamped:
        """The transform that converts data in source_frame to target_frame. It does not wait.

        Raises:
            TransformException: it is not available; the subclass and the message say why.
        """
        with self._lock:
            stamp, transform = self._lookup(
                "lookupTransform", target_frame, source_frame, nanoseconds(time)
            )
        return transform_message(stamp, target_frame, source_frame, transform)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Stamp,
        source_frame: str,
        source_time: Time | Stamp,
        fixed_frame: str,
    ) -> TransformStamped:
        """The transform from source_frame at one time to target_frame at another, by way of fixed_frame."""
        function = "lookupTransform"
        with self._lock:
            self._check_frames(function, target=target_frame, source=source_frame, fixed=fixed_frame)
            _, first = self._lookup(function, fixed_frame, source_frame, nanoseconds(source_time))
            stamp, second = self._lookup(function, target_frame, fixed_frame, nanoseconds(target_time))
        return transform_message(stamp, target_frame, source_frame, second.after(first))

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time | Stamp
    ) -> tuple[bool, str]:
        """Return whether lookup_transform_core would succeed, and if not, why."""
        with self._lock:
            return _succeeds(
                lambda: self._lookup("canTransform", target_frame, source_frame, nanoseconds(time))
            )

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | Stamp,
        source_frame: str,
        source_time: Time | Stamp,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """Return whether lookup_transform_full_core would succeed, and if not, why."""
        function = "canTransform"

        def lookup_both() -> None:
            self._check_frames(function, target=target_frame, source=source_frame, fixed=fixed_frame)
            self._lookup(function, target_frame, fixed_frame, nanoseconds(target_time))
            self._lookup(function, fixed_frame, source_frame, nanoseconds(source_time))

        with self._lock:
            return _succeeds(lookup_both)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """The latest time at which all transforms between two frames are available.

        Raises:
            TransformException: the frames are not connected.
        """
        with self._lock:
            for frame in (target_frame, source_frame):
                if frame not in self._frames:
                    raise LookupException(f"Frame {frame} does not exist.")
            return Time(nanoseconds=self._frames.latest_common_time(target_frame, source_frame))

    def clear(self) -> None:
        """Remove all transforms of moving frames; the frames and the static transforms remain."""
        with self._lock:
            self._latest.clear()
            for cache in self._frames.values():
                if cache is not None:
                    cache.clear()

    def all_frames_as_string(self) -> str:
        """Each frame and its parent, one per line."""
        with self._lock:
            return self._frames.as_string()

    def all_frames_as_yaml(self) -> str:
        """Parent, broadcaster, rate (Hz), times and buffer length (s) of each frame, as YAML."""
        with self._lock:
            caches = [(name, cache) for name, cache in self._frames.items() if cache and cache.latest]
            texts = [frame_yaml(name, self._authorities[name], cache) for name, cache in caches]
            return "".join(texts) if self._frames else "[]"

    def _frameExists(self, frame_id: str) -> bool:
        return frame_id in self._frames

    def _getFrameStrings(self) -> list[str]:
        return list(self._frames)

    def _set(self, message: TransformStamped, authority: str, kind: type[FrameCache]) -> None:
        parent, child = strip_slash(message.header.frame_id), strip_slash(message.child_frame_id)
        translation, rotation = message.transform.translation, message.transform.rotation
        transform = RigidTransform(
            (rotation.x, rotation.y, rotation.z, rotation.w), (translation.x, translation.y, translation.z)
        )
        errors = transform_errors(parent, child, transform, authority)
        for error in errors:
            get_logger("tf2").error(error)
        if errors:
            return
        with self._lock:
            self._latest.clear()
            cache = self._frames.get(child)
            if not isinstance(cache, kind):
                cache = TimeCache(self._cache_time) if kind is TimeCache else StaticCache()
                self._frames[child] = cache
            self._frames.setdefault(parent, None)
            stamp = nanoseconds(message.header.stamp)
            if cache.insert(StoredTransform(stamp, parent, transform)):
                self._authorities[child] = authority
            else:
                get_logger("tf2").warning(
                    f"TF_OLD_DATA ignoring data from the past for frame {child} at time "
                    f"{format_seconds(stamp)} according to authority {authority}\n"
                    "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained"
                )

    def _check_frames(self, function: str, **frames: str) -> None:
        for role, frame in frames.items():
            check_frame_id(function, f"{role}_frame", frame, self._frames)

    def _lookup(
        self, function: str, target: str, source: str, time: Nanoseconds
    ) -> tuple[Nanoseconds, RigidTransform]:
        """The stamp and the transform from the source to the target."""
        if time:
            return self._compute(function, target, source, time)
        if (target, source) not in self._latest:
            self._latest[target, source] = self._compute(function, target, source, time)
        return self._latest[target, source]

    def _compute(
        self, function: str, target: str, source: str, time: Nanoseconds
    ) -> tuple[Nanoseconds, RigidTransform]:
        if target == source:
            cache = self._frames.get(target)
            return (cache.span[1] if cache is not None and time == 0 else time), IDENTITY
        check_frame_id(function, "target_frame", target, self._frames)
        check_frame_id(function, "source_frame", source, self._frames)
        time = time or self._frames.latest_common_time(target, source)
        top, source_path, source_error = self._frames.walk_up(source, (target,), time)
        end, target_path, target_error = self._frames.walk_up(target, (top, source), time)
        if end == source:  # an ancestor of the target: errors above it don't matter
            top, source_path = source, []
        error = target_error or (source_error if end != top else None)
        if error is not None:
            where = f", when looking up transform from frame [{source}] to frame [{target}]"
            raise type(error)(f"{error}{where}")
        if end != top:
            raise connectivity_error(target, source)
        return time, compose(target_path).inverse().after(compose(source_path))


def nanoseconds(time: Time | Stamp) -> Nanoseconds:
    """The nanoseconds of an rclpy Time or a message's stamp."""
    return time.nanoseconds if isinstance(time, Time) else time.sec * SECOND + time.nanosec


def _succeeds(lookup: Callable[[], object]) -> tuple[bool, str]:
    try:
        lookup()
    except TransformException as error:
        return False, str(error)
    return True, ""
