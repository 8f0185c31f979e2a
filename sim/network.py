"""The simulated network between the hosts of a run, which delays and loses messages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import inf
from typing import Any

ROBOT, LAPTOP = "robot", "laptop"  # the hosts of the robot's own programs and of the student's
HostPair = tuple[str, str]


@dataclass(frozen=True)
class Network:
    """Network conditions between hosts. Messages between programs on the same host don't pass through it.

    loss: the fraction of messages that are lost, 0 to 1.
    delay: latency of each message, in seconds. jitter: the latency varies by up to this much either way (s).
    bandwidth: bytes per second from one host to another, shared by all messages there; None for no limit.
    A message that would be queued for more than a second is lost.
    links: different conditions between two hosts, such as {("laptop", "robot"): Network(loss=0.5)}; for both
    directions, unless the reverse pair has its own entry.

    Raises ValueError for a value out of range, TypeError for one of a wrong type.
    """

    loss: float = 0.0
    delay: float = 0.0
    jitter: float = 0.0
    bandwidth: float | None = None
    links: Mapping[HostPair, Network] = field(default_factory=dict)

    def __post_init__(self) -> None:
        _check("loss", self.loss, 1.0, "a share from 0 to 1")
        for name in ("delay", "jitter"):
            _check(name, getattr(self, name), inf, "seconds, 0 or more")
        if self.bandwidth is not None:
            _check("bandwidth", self.bandwidth, inf, "bytes per second, more than 0, or None")
            if self.bandwidth == 0:
                raise ValueError("bandwidth must be bytes per second, more than 0, or None; it is 0.")
        for pair, network in self.links.items():
            if not (
                isinstance(pair, tuple) and len(pair) == 2 and all(isinstance(host, str) for host in pair)
            ):
                raise ValueError(f'links are between two hosts, as in ("laptop", "robot"); this is {pair!r}.')
            if not isinstance(network, Network) or network.links:
                raise TypeError(f"The link {pair!r} must be a Network without links; it is {network!r}.")

    def between(self, sender: str, receiver: str) -> Network:
        """The network conditions from one host to another."""
        return self.links.get((sender, receiver)) or self.links.get((receiver, sender)) or self

    def to_data(self) -> dict[str, Any]:
        """The network as plain data, for JSON."""
        links = [[*pair, link.to_data()] for pair, link in self.links.items()]
        return asdict(self) | {"links": sorted(links, key=lambda row: row[:2])}

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Network:
        """The network that `to_data` described."""
        links = {(one, other): cls.from_data(link) for one, other, link in data["links"]}
        return cls(**{**data, "links": links})


def _check(name: str, value: Any, most: float, what: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{name} must be {what}; it is {value!r}.")
    if not 0 <= value <= most or value == inf:
        raise ValueError(f"{name} must be {what}; it is {value!r}.")
