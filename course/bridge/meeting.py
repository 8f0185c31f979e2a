"""Two programs in processes of their own, each with its own environment: do they discover each other?

    python meeting.py talk          publishes on /chatter until Ctrl-C
    python meeting.py listen 4      waits for a message, for 4 s at most
    python meeting.py look 4        prints the topics that it discovers, as soon as /chatter is one of them
    python meeting.py daemon        answers other programs that ask for topics, until Ctrl-C
    python meeting.py ask           prints the topics that the daemon of its domain names
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import sysconfig
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

DOMAIN = random.randrange(10, 90)  # not that of others on this computer
SERVER = f"127.0.0.1:{random.randrange(12000, 20000)}"
READY = "ready"


def environment(**settings: str) -> dict[str, str]:
    """That of a terminal on this computer only, in our domain, with these settings."""
    set_by_the_course = ("ROS_", "RMW_", "FASTDDS_")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(set_by_the_course)}
    usual = {"ROS_DOMAIN_ID": str(DOMAIN), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    return kept | usual | {name: str(value) for name, value in settings.items()}


def start(*words: str, **settings: str) -> subprocess.Popen:
    """Start this file as a program."""
    command = [sys.executable, __file__, *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.Popen(command, env=environment(**settings), **pipes)


@contextmanager
def running(program: subprocess.Popen) -> Iterator[subprocess.Popen]:
    """A program that is ready; it gets Ctrl-C at the end."""
    program.stdout.readline()
    try:
        yield program
    finally:
        program.send_signal(signal.SIGINT)
        program.communicate()


def meet(
    talker: dict[str, str] | None = None, listener: dict[str, str] | None = None, seconds: float = 3
) -> str:
    """Whether a listener receives what a talker publishes; each is given its settings."""
    with running(start("talk", **(talker or {}))):
        printed = start("listen", str(seconds), **(listener or {})).communicate()[0]
    return printed.splitlines()[-1]


def ports_in_use() -> set[int]:
    """The UDP ports that programs of this computer have opened."""
    lines = Path("/proc/net/udp").read_text(encoding="utf-8").splitlines()[1:]
    return {int(line.split()[1].split(":")[1], 16) for line in lines}


@contextmanager
def discovery_server() -> Iterator[str]:
    """Fast DDS's discovery server, from the package that set-up installed; its address."""
    folder = Path(sysconfig.get_path("platlib"))
    libraries = f"{sys.prefix}/lib{os.pathsep}{folder / 'ros_fastrtps.libs'}"
    address, port = SERVER.split(":")
    program = shutil.which("fast-discovery-server", path=f"{sys.prefix}/bin{os.pathsep}{os.environ['PATH']}")
    server = subprocess.Popen(
        [program, "-i", "0", "-l", address, "-p", port],
        env=environment(LD_LIBRARY_PATH=libraries),
        stdout=subprocess.PIPE,
        text=True,
    )
    with running(server):
        yield SERVER


def _talk() -> None:
    import rclpy
    from rclpy.executors import ExternalShutdownException
    from std_msgs.msg import String

    rclpy.init(args=sys.argv)
    node = rclpy.create_node("talker")
    publisher = node.create_publisher(String, "/chatter", 10)
    node.create_timer(0.1, lambda: publisher.publish(String(data="hello")))
    print(READY, flush=True)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


def _listen(seconds: float) -> None:
    import rclpy
    from std_msgs.msg import String

    rclpy.init()
    node, received = rclpy.create_node("listener"), []
    node.create_subscription(String, "/chatter", received.append, 10)
    begin = time.monotonic()
    while not received and time.monotonic() < begin + seconds:
        rclpy.spin_once(node, timeout_sec=0.1)
    print(f"received {received[0].data}" if received else f"nothing in {seconds:g} s")


def _look(seconds: float) -> None:
    import rclpy

    rclpy.init()
    node, begin, topics = rclpy.create_node("looker"), time.monotonic(), {}
    while "/chatter" not in topics and time.monotonic() < begin + seconds:
        time.sleep(0.1)
        topics = dict(node.get_topic_names_and_types())
    print(*sorted(topics))


def _daemon() -> None:
    from xmlrpc.server import SimpleXMLRPCServer

    import rclpy

    rclpy.init()
    node = rclpy.create_node("daemon")
    server = SimpleXMLRPCServer(_address_of_daemon(), logRequests=False)
    server.register_function(lambda: sorted(dict(node.get_topic_names_and_types())), "topics")
    print(READY, flush=True)
    with suppress(KeyboardInterrupt):
        server.serve_forever()


def _ask() -> None:
    from xmlrpc.client import ServerProxy

    host, port = _address_of_daemon()
    print(*ServerProxy(f"http://{host}:{port}").topics())


def _address_of_daemon() -> tuple[str, int]:
    """One for each domain, as with the official daemon, whose ports begin at 11511."""
    return "127.0.0.1", 31511 + int(os.environ["ROS_DOMAIN_ID"])


PROGRAMS = {"talk": _talk, "listen": _listen, "look": _look, "daemon": _daemon, "ask": _ask}

if __name__ == "__main__":
    # From --ros-args on, the words are ROS's.
    words = sys.argv[2 : sys.argv.index("--ros-args") if "--ros-args" in sys.argv else None]
    PROGRAMS[sys.argv[1]](*map(float, words))
