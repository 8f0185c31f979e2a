"""The base class of events."""


class Event:
    """Something that happened while a launch file is executed. Event handlers react to it."""

    name = "launch.Event"
