"""What every buffer can do, and which types of messages can be taken into another frame."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar

from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from std_msgs.msg import Header


class TypeException(Exception):
    """Nothing is registered for a type, so it can't be transformed or converted."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """A buffer lacks can_transform or lookup_transform."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class BufferInterface:
    """Takes messages into other frames; where these are, a subclass knows."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
        new_type: type | None = None,
    ) -> Any:
        """A message with a header, seen from target_frame at its own stamp; timeout: how long to wait.

        new_type: what it becomes then, if this has been registered.

        Raises:
            TransformException: the transform can't be had.
            TypeException: nothing is registered for the type; tf2_geometry_msgs registers its own on import.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _as(do_transform(object_stamped, transform), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
        new_type: type | None = None,
    ) -> Any:
        """The same, seen from where target_frame is at target_time, while fixed_frame stands still."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _as(do_transform(object_stamped, transform), new_type)

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> TransformStamped:
        """A subclass looks it up."""
        raise NotImplementedException()

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> TransformStamped:
        """A subclass looks it up."""
        raise NotImplementedException()

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> bool:
        """A subclass knows."""
        raise NotImplementedException()

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> bool:
        """A subclass knows."""
        raise NotImplementedException()


def Stamped(obj: Any, stamp: Time, frame_id: str) -> Any:
    """Give an object a header; stamp is that of a message."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class TransformRegistration:
    """Which function takes a type into another frame; one table for all."""

    _transforms: ClassVar[dict[type, Callable[[Any, TransformStamped], Any]]] = {}

    def print_me(self) -> None:
        """Print the table."""
        print(self._transforms)

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register a type: callback(message, transform) gives the transformed message."""
        self._transforms[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """The function of a type. Raises TypeException."""
        return _found(self._transforms, key)


class ConvertRegistration:
    """Which function makes one type of another; one table for all."""

    _to_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _from_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _convert: ClassVar[dict[Any, Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register what makes this type of a message."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register what makes a message of this type."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register what makes the second type of the first."""
        self._convert[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """What makes this type of a message. Raises TypeException."""
        return _found(self._from_msg, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """What makes a message of this type. Raises TypeException."""
        return _found(self._to_msg, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """What makes the second type of the first. Raises TypeException."""
        return _found(self._convert, key)


def convert(a: Any, b_type: type) -> Any:
    """An object as another type: directly, or by way of a message.

    Raises:
        TypeException: nobody registered how.
    """
    known = ConvertRegistration()
    try:
        return known.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
        return known.get_from_msg(b_type)(known.get_to_msg(type(a))(a))


def _found(table: dict[Any, Callable], key: Any) -> Callable:
    if key not in table:
        raise TypeException(f"Type {key} is not loaded or supported")
    return table[key]


def _as(result: Any, new_type: type | None) -> Any:
    return result if new_type is None else convert(result, new_type)
