"""Ports for servers that tests start."""
import random
import socket
from contextlib import ExitStack

# Below those that Linux gives to connections (ip_local_port_range): no other program gets them by chance.
FIRST, LAST = 20_000, 32_000


def free_port(count: int = 1) -> int:
    """The first of `count` ports of this machine, one after the other, that nothing uses now."""
    while True:
        first = random.SystemRandom().randrange(FIRST, LAST - count)
        try:
            with ExitStack() as stack:
                for port in range(first, first + count):
                    stack.enter_context(socket.socket()).bind(("127.0.0.1", port))
        except OSError:
            continue
        return first
