"""The network between hosts: when what is sent on it arrives, and whether it does."""

from __future__ import annotations

from random import Random

from sim.nanoseconds import SECOND, Nanoseconds, nanoseconds
from sim.network import Network

MOST_WAITING: Nanoseconds = SECOND  # of data before a narrow link; what comes on top of that is lost


class HostLink:
    """The link from one host to another, which all messages in this direction share."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self._free_at: Nanoseconds = 0

    def cross(self, random: Random, size: int, now: Nanoseconds) -> Nanoseconds | None:
        """Return when a packet of so many bytes that is sent now arrives; None if it is lost."""
        bandwidth, start = self.network.bandwidth, now
        if bandwidth is not None:
            start = max(now, self._free_at)
            if start - now > MOST_WAITING:
                return None
            start = self._free_at = start + nanoseconds(size / bandwidth)
        return self.travel(random, start)

    def travel(self, random: Random, start: Nanoseconds) -> Nanoseconds | None:
        """The same for a packet that is too short to need bandwidth, or that is sent only later."""
        network = self.network
        lost, shift = random.random() < network.loss, random.uniform(-1, 1) * network.jitter
        return None if lost else start + nanoseconds(max(network.delay + shift, 0.0))


class HostLinks:
    """All links of one run."""

    def __init__(self, network: Network, seed: int) -> None:
        self._network, self._seed = network, seed
        self._links: dict[tuple[str, str], HostLink] = {}

    def between(self, sender: str, receiver: str) -> HostLink:
        """The link from this host to that one."""
        pair = sender, receiver
        if pair not in self._links:
            self._links[pair] = HostLink(self._network.between(*pair))
        return self._links[pair]

    def random(self, *names: str) -> Random:
        """A generator for what these names mean: what others send doesn't shift it."""
        return Random(" ".join(("network of run", str(self._seed), *names)))
