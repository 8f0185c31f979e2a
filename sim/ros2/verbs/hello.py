"""ros2 doctor hello: whether machines in a network reach each other, by a topic and by UDP multicast."""

from __future__ import annotations

import contextlib
import socket
import struct
import time
from argparse import Namespace
from collections import Counter

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_system_default
from std_msgs.msg import String

from sim.ros2.group import argument, flag
from sim.ros2.print_options import positive_int
from sim.ros2.system import CliError, Output, System
from sim.ros2.verbs.doctor import doctor
from sim.ros2.verbs.publishing import positive_float

GROUP, PORT = "225.0.0.1", 49150
GREETING = "hello, it's me"
MAX_DATAGRAM = 4096  # bytes


@doctor.verb(
    "hello",
    argument("-t", "--topic", nargs="?", default="/canyouhearme", help="Topic (default: '/canyouhearme')"),
    argument("-ep", "--emit-period", metavar="N", type=positive_float, default=0.1, help="s (default: 0.1)"),
    argument("-pp", "--print-period", metavar="N", type=positive_float, default=1.0, help="s (default: 1.0)"),
    argument("--ttl", type=positive_int, help="TTL for multicast send (default: None)"),
    flag("-1", "--once", help="Publish and multicast send for one emit period then exit"),
)
def hello(system: System, options: Namespace) -> None:
    """Check network connectivity between multiple hosts."""
    if system.finished or system.time_limit is not None:
        raise CliError("`ros2 doctor hello` communicates with other machines: type it in a terminal of each.")
    system.run_with_node(lambda node, output: _hello(node, output, options))


class Greetings:
    """Messages sent to other hosts and received from them since the last table. host: this one's name."""

    def __init__(self, host: str) -> None:
        self.host = host
        self.published = self.sent = 0
        self.subscribed: Counter[str] = Counter()
        self.received: Counter[str] = Counter()

    @property
    def text(self) -> str:
        """Return what to send."""
        return f"{GREETING} {self.host}"

    def count(self, counts: Counter[str], text: str) -> None:
        """Count a greeting of another host."""
        sender = (text.split() or [self.host])[-1]
        if sender != self.host:
            counts[sender] += 1

    def table(self, topic: str, period: float) -> str:
        """The table as the official command prints it."""
        title = f"{'':<15} {'Hostname':<20} {f'Msg Count /{period}s':<10}"
        rows = [
            [title, *(f"{'':<15} {host:<20} {count:<10}" for host, count in counts.items())]
            for counts in (self.subscribed, self.received)
        ]
        return "\n".join([
            "MULTIMACHINE COMMUNICATION SUMMARY",
            f"Topic: {topic}, Published Msg Count: {self.published}",
            "Subscribed from:",
            *rows[0],
            f"Multicast Group/Port: {GROUP}/{PORT}, Sent Msg Count: {self.sent}",
            "Received from:",
            *rows[1],
            "-" * 60,
        ])  # fmt: skip


def _hello(node: Node, output: Output, options: Namespace) -> None:
    host = socket.gethostname()
    greetings = Greetings(host)
    publisher = node.create_publisher(String, options.topic, qos_profile_system_default)
    node.create_subscription(
        String,
        options.topic,
        lambda message: greetings.count(greetings.subscribed, message.data),  # type: ignore[attr-defined]
        qos_profile_system_default,
    )
    printed = time.monotonic()
    with _sender(options.ttl) as sender, _receiver() as receiver:
        while not output.canceled:
            if time.monotonic() - printed > options.print_period:
                output.print_line(greetings.table(options.topic, options.print_period))
                greetings, printed = Greetings(host), time.monotonic()
            publisher.publish(String(data=greetings.text))
            greetings.published += 1
            with contextlib.suppress(OSError):  # a machine without a network
                sender.sendto(greetings.text.encode(), (GROUP, PORT))
                greetings.sent += 1
            _spin(node, options.emit_period)
            _receive(receiver, greetings)
            if options.once:
                output.print_line(greetings.table(options.topic, options.print_period))
                return


def _spin(node: Node, seconds: float) -> None:
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0:
        rclpy.spin_once(node, timeout_sec=left)


def _sender(ttl: int | None) -> socket.socket:
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)
    if ttl is not None:
        made.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, struct.pack("b", ttl))
    return made


def _receiver() -> socket.socket:
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)
    for option in (socket.SO_REUSEADDR, socket.SO_REUSEPORT):
        made.setsockopt(socket.SOL_SOCKET, option, 1)
    made.bind(("", PORT))
    made.setblocking(False)
    membership = struct.pack("4sl", socket.inet_aton(GROUP), socket.INADDR_ANY)
    with contextlib.suppress(OSError):  # a machine without a network
        made.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
    return made


def _receive(receiver: socket.socket, greetings: Greetings) -> None:
    """Count all that has arrived."""
    with contextlib.suppress(BlockingIOError):
        while True:
            data, _ = receiver.recvfrom(MAX_DATAGRAM)
            greetings.count(greetings.received, data.decode(errors="replace"))
