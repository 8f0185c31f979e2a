"""The interface of buffers, and the types of messages that they can transform."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar

from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from std_msgs.msg import Header


class TypeException(Exception):
    """No function is registered that transforms or converts a type."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """A buffer lacks can_transform or lookup_transform."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class BufferInterface:
    """Transforms messages to other frames. Subclasses look up the transforms."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
        new_type: type | None = None,
    ) -> Any:
        """A message with a header, transformed to target_frame at its own stamp.

        timeout: how long to wait for the transform. new_type: convert the result to this type.

        Raises:
            TransformException: the transform is not available.
            TypeException: the type isn't registered; importing tf2_geometry_msgs registers its types.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, transform), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
        new_type: type | None = None,
    ) -> Any:
        """Work like `transform`, but to target_frame at target_time, assuming fixed_frame doesn't move."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, transform), new_type)

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> TransformStamped:
        """Implemented by subclasses."""
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
        """Implemented by subclasses."""
        raise NotImplementedException()

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),  # noqa: B008 - upstream's default
    ) -> bool:
        """Implemented by subclasses."""
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
        """Implemented by subclasses."""
        raise NotImplementedException()


def Stamped(obj: Any, stamp: Time, frame_id: str) -> Any:
    """Set the header of an object; stamp is a message."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


class TransformRegistration:
    """The functions that transform messages, by type. All instances share one table."""

    _transforms: ClassVar[dict[type, Callable[[Any, TransformStamped], Any]]] = {}

    def print_me(self) -> None:
        """Print the table."""
        print(self._transforms)

    def add(self, key: type, callback: Callable[[Any, TransformStamped], Any]) -> None:
        """Register callback(message, transform), which returns the transformed message, for a type."""
        self._transforms[key] = callback

    def get(self, key: type) -> Callable[[Any, TransformStamped], Any]:
        """The function for a type. Raises TypeException."""
        return _get(self._transforms, key)


class ConvertRegistration:
    """The functions that convert between types. All instances share one table."""

    _to_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _from_msg: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _convert: ClassVar[dict[Any, Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register a function that converts a message to this type."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Register a function that converts this type to a message."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Register a function that converts the first type to the second."""
        self._convert[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """The function that converts a message to this type. Raises TypeException."""
        return _get(self._from_msg, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """The function that converts this type to a message. Raises TypeException."""
        return _get(self._to_msg, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """The function that converts the first type to the second. Raises TypeException."""
        return _get(self._convert, key)


def convert(a: Any, b_type: type) -> Any:
    """An object converted to another type, directly or through a message.

    Raises:
        TypeException: no function is registered for it.
    """
    registration = ConvertRegistration()
    try:
        return registration.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
        return registration.get_from_msg(b_type)(registration.get_to_msg(type(a))(a))


def _get(table: dict[Any, Callable], key: Any) -> Callable:
    if key not in table:
        raise TypeException(f"Type {key} is not loaded or supported")
    return table[key]


def _converted(result: Any, new_type: type | None) -> Any:
    return result if new_type is None else convert(result, new_type)
