"""Why a transform can't be had.

TransformException
├── LookupException             a frame of that name is not known
├── ConnectivityException       no way leads from one frame to the other
├── ExtrapolationException      for that moment there is no data, or none yet
├── InvalidArgumentException    that can't be the name of a frame
└── TimeoutException            it did not come in time
"""


class TransformException(Exception):
    """A transform can't be had; the others tell why."""


class LookupException(TransformException):
    """A frame of that name is not known."""


class ConnectivityException(TransformException):
    """No way leads from one frame to the other."""


class ExtrapolationException(TransformException):
    """For that moment there is no data, or none yet."""


class InvalidArgumentException(TransformException):
    """That can't be the name of a frame."""


class TimeoutException(TransformException):
    """The transform did not come in time."""
