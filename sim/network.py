"""What lies between the computers of a run: messages on the way there are late, and some are lost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import inf
from typing import Any

ROBOT, LAPTOP = "robot", "laptop"  # where the robot's own programs run, and where the student's do
Pair = tuple[str, str]


@dataclass(frozen=True)
class Network:
    """How messages get from one host to another. Programs of one host don't need it.

    loss: the share of messages that are lost on the way, 0 to 1.
    delay: seconds that each is on its way. jitter: by so much each may be faster or slower.
    bandwidth: bytes per second from one host to another, shared by all messages there; None for no limit.
    What would have to wait for more than a second is lost.
    links: other networks between two hosts, such as {("laptop", "robot"): Network(loss=0.5)}; for both ways,
    unless there is another for the way back.

    Raises ValueError for what no network can do, TypeError for what is none.
    """

    loss: float = 0.0
    delay: float = 0.0
    jitter: float = 0.0
    bandwidth: float | None = None
    links: Mapping[Pair, Network] = field(default_factory=dict)

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
        """What lies on the way from one host to another."""
        return self.links.get((sender, receiver)) or self.links.get((receiver, sender)) or self

    def to_data(self) -> dict[str, Any]:
        """As plain data, for JSON."""
        links = [[*pair, link.to_data()] for pair, link in self.links.items()]
        return asdict(self) | {"links": sorted(links, key=lambda row: row[:2])}

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Network:
        """The network of such data."""
        links = {(one, other): cls.from_data(link) for one, other, link in data["links"]}
        return cls(**{**data, "links": links})


def _check(name: str, value: Any, most: float, what: str) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{name} must be {what}; it is {value!r}.")
    if not 0 <= value <= most or value == inf:
        raise ValueError(f"{name} must be {what}; it is {value!r}.")
