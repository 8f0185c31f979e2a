"""The channels from one publisher to the subscriptions on other hosts."""

from __future__ import annotations

from rclpy.qos import ReliabilityPolicy

from sim.ros.transport.channels import Channel, ReliableChannel
from sim.ros.transport.endpoint import PublisherEndpoint, Sample
from sim.ros.transport.history import History
from sim.ros.transport.reader import DataReader


class OutgoingChannels:
    """The channels of one publisher."""

    def __init__(self, writer: PublisherEndpoint) -> None:
        self._writer = writer
        self._history = History(writer)
        self.has_room, self.all_acknowledged = self._history.has_room, self._history.all_acknowledged
        self.channels: list[Channel] = []

    def connect(self, reader: DataReader, latched: list[Sample]) -> None:
        """Send what is published to this subscription, too, and these messages at once."""
        writer = self._writer
        endpoints = writer.profile, reader.profile
        if all(profile.reliability is ReliabilityPolicy.RELIABLE for profile in endpoints):
            channel = ReliableChannel(writer, reader, self._history)
            self._history.channels.append(channel)
        else:
            channel = Channel(writer, reader)
        self.channels.append(channel)
        if latched:
            self._history.restore(latched)
        for sample in latched:
            channel.send(sample)

    def send(self, sample: Sample) -> None:
        """Send a message on every channel."""
        if self._history.channels:
            self._history.add(sample)
        for channel in self.channels:
            if self._writer.has_discovered(channel.reader):
                channel.send(sample)
            else:
                self._writer.run.recorder.undelivered(self._writer.sender, self._writer.topic)

    def disconnect(self, reader: DataReader) -> None:
        """A subscription was destroyed."""
        for channel in [channel for channel in self.channels if channel.reader is reader]:
            channel.open = False
            self.channels.remove(channel)
            if channel in self._history.channels:
                self._history.channels.remove(channel)
        self._history.acknowledged()

    def close(self) -> None:
        """The publisher was destroyed."""
        self._history.clear()
