"""The robot as a stand-alone program, for ordinary ROS 2 nodes and tools: python -m sim --world maze"""

from __future__ import annotations

import argparse
import math
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager, nullcontext
from types import FrameType
from typing import NoReturn

from sim.ros.realtime import ArgumentsError, RealTimeRun, own_words
from sim.ros2.domains import COURSE_DOMAIN, LAST_DOMAIN
from sim.world import World, WorldError

PORT, LAST_PORT = 8090, 65535
PORTS = range(PORT, PORT + 10)  # without --port, the first free one
USAGE_ERROR = 2  # exit status, as argparse's
CONNECT_HELP = """
In another terminal:
  export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
  python my_node.py        # or ros2 topic list, as in JupyterLab's terminals

Ctrl-C ends it."""


def main(arguments: list[str] | None = None) -> int:
    """Run until Ctrl-C or SIGTERM; returns the exit status."""
    stopped = threading.Event()
    _stop_on_signals(stopped)
    arguments = sys.argv[1:] if arguments is None else arguments
    try:
        options = _options(own_words(arguments))
        with (
            RealTimeRun(_world(options), options.seed, options.domain, arguments) as run,
            nullcontext() if options.headless else _page(run, _ports(options)) as address,
        ):
            print(_summary(run, address), flush=True)
            run.spin(stopped.is_set)
    except (WorldError, PortError, ArgumentsError) as error:
        print(error, file=sys.stderr)
        return USAGE_ERROR
    return 0


class PortError(Exception):
    """No port is free for the page."""


@contextmanager
def _page(run: RealTimeRun, ports: Sequence[int]) -> Iterator[str]:
    """Serve the page that shows the run; yields its address."""
    from sim.standalone import LivePage  # imported here because a headless robot doesn't need its libraries

    try:
        page = LivePage(run, ports)
    except OSError as error:
        raise PortError(
            f"Port {ports[-1]} can't be used ({error.strerror}); choose another with --port."
        ) from error
    with closing(page):
        yield page.address


def _ports(options: argparse.Namespace) -> Sequence[int]:
    return PORTS if options.port is None else [options.port]


def _stop_on_signals(stopped: threading.Event) -> None:
    def stop(number: int, frame: FrameType | None) -> None:
        stopped.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(USAGE_ERROR, f"{self.prog}: {message}\n")


def _options(arguments: list[str]) -> argparse.Namespace:
    parser = _Parser(
        "python -m sim", description="A simulated robot as an ordinary ROS 2 process, in real time."
    )
    option = parser.add_argument
    seed = _number("write a whole number, 0 or more")
    domain = _number(f"a ROS domain is a whole number from 0 to {LAST_DOMAIN}", LAST_DOMAIN)
    port = _number(f"a port is a whole number from 0 to {LAST_PORT}", LAST_PORT)
    option("--world", default="room", help=f"{', '.join(World.names())}, or a .toml file; default room")
    option("--world-seed", type=seed, help="make a new room, maze, clutter or warehouse from this number")
    option("--seed", type=seed, default=0, help="for the sensors' noise; default 0")
    domains = f"ROS domain, 0 to {LAST_DOMAIN}; default {COURSE_DOMAIN}"
    option("--domain", type=domain, default=COURSE_DOMAIN, help=domains)
    free = f"default {PORT}, or the next that is free"
    option("--port", type=port, help=f"of the picture in a browser, 0 for any; {free}")
    option("--headless", action="store_true", help="without the picture")
    return parser.parse_args(arguments)


def _number(expected: str, most: float = math.inf) -> Callable[[str], int]:
    def number(text: str) -> int:
        if not text.isdecimal() or int(text) > most:
            raise argparse.ArgumentTypeError(f"{expected}; this is {text!r}.")
        return int(text)

    return number


def _world(options: argparse.Namespace) -> World:
    if options.world_seed is None:
        return World.load(options.world)
    return World.generate(options.world, seed=options.world_seed)


def _summary(run: RealTimeRun, address: str | None) -> str:
    """The world, the domain, the topics and the page's address, for the terminal."""
    lines = [f"World {run.scene.world.name!r} in real time, ROS domain {run.domain}, this machine only."]
    for what, topics in (("takes", run.takes), ("gives", run.gives)):
        lines += [f"  {what} {name}  [{kind}]" for name, kind in topics.items()]
    lines += [f"See and drive it at {address}"] if address else []
    return "\n".join(lines) + "\n" + CONNECT_HELP.format(domain=run.domain)


if __name__ == "__main__":
    sys.exit(main())
