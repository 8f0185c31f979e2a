"""The exceptions of tf2.

TransformException
├── LookupException             the frame does not exist
├── ConnectivityException       the frames are not in the same tree
├── ExtrapolationException      there is no data for that time, or not yet
├── InvalidArgumentException    the frame id is not valid
└── TimeoutException            the transform did not become available in time
"""


class TransformException(Exception):
    """The transform is not available; the subclass says why."""


class LookupException(TransformException):
    """The frame does not exist."""


class ConnectivityException(TransformException):
    """The frames are not in the same tree."""


class ExtrapolationException(TransformException):
    """There is no data for that time, or not yet."""


class InvalidArgumentException(TransformException):
    """The frame id is not valid."""


class TimeoutException(TransformException):
    """The transform did not become available in time."""
