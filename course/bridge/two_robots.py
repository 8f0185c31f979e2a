"""Two robots in two domains, and a driver in one of them: real processes, in real time.

    python two_robots.py drive      publishes on /cmd_vel until Ctrl-C
    python two_robots.py watch      prints where the robot is until Ctrl-C
"""

import math
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress

from IPython.display import Image, display
from matplotlib.figure import Figure
from meeting import DOMAIN, environment

DOMAINS = (DOMAIN, DOMAIN + 1)
FAR, PATIENCE = 1.0, 600.0  # m that the driven robot moves; s, only against waiting forever
PERIOD = 0.25  # s between two pictures

Place = tuple[float, float]


def drive_one_of_two() -> None:
    """Start both robots, a driver in the first one's domain, and show where both are until one is far."""
    places: list[list[Place]] = [[], []]
    shown = display(_picture(places), display_id=True)
    deadline = time.monotonic() + PATIENCE
    with ExitStack() as programs:
        for domain, seen in zip(DOMAINS, places, strict=True):
            robot = ("-m", "sim", "--headless", "--world", "yard", "--domain", str(domain))
            programs.enter_context(_program(domain, *robot))
            watcher = programs.enter_context(_program(domain, __file__, "watch"))
            threading.Thread(target=_read, args=(watcher, seen), daemon=True).start()
        while not all(places) and time.monotonic() < deadline:
            time.sleep(PERIOD)
        programs.enter_context(_program(DOMAINS[0], __file__, "drive"))
        while max(map(_moved, places)) < FAR and time.monotonic() < deadline:
            time.sleep(PERIOD)
            shown.update(_picture(places))
    for domain, seen in zip(DOMAINS, places, strict=True):
        print(f"the robot in domain {domain}: {'it drives' if _moved(seen) > 0.1 else 'it stands still'}")


@contextmanager
def _program(domain: int, *words: str) -> Iterator[subprocess.Popen]:
    """A Python program in a domain, which is ended at the end."""
    command = [sys.executable, *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, "text": True}
    program = subprocess.Popen(command, env=environment(ROS_DOMAIN_ID=str(domain)), **pipes)
    try:
        yield program
    finally:
        program.terminate()
        program.wait()


def _read(watcher: subprocess.Popen, places: list[Place]) -> None:
    for line in watcher.stdout:
        x, y = map(float, line.split())
        places.append((x, y))


def _moved(places: Sequence[Place]) -> float:
    return math.dist(places[0], places[-1]) if places else 0.0


def _picture(places: Sequence[Sequence[Place]]) -> Image:
    from sim.view import png  # not in the programs below: `sim` keeps a process's messages to itself

    figure = Figure(figsize=(6, 2.6))
    for index, (domain, seen) in enumerate(zip(DOMAINS, places, strict=True)):
        axes = figure.add_subplot(1, 2, index + 1)
        axes.set(title=f"domain {domain}", xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), aspect="equal")
        axes.plot(*zip(*seen, strict=True) if seen else ([], []))
        axes.plot(*(seen[-1] if seen else (0.0, 0.0)), "o", markersize=12)
    return Image(png(figure))


def _drive() -> None:
    import rclpy
    from geometry_msgs.msg import Twist

    node = rclpy.create_node("driver")
    command = Twist()
    command.linear.x = 0.3
    publisher = node.create_publisher(Twist, "/cmd_vel", 10)
    node.create_timer(0.1, lambda: publisher.publish(command))
    try:
        rclpy.spin(node)
    finally:
        publisher.publish(Twist())  # a robot that must stand is sent zeros
        time.sleep(0.2)  # so that it gets there


def _watch() -> None:
    import rclpy
    from nav_msgs.msg import Odometry

    def show(odometry: Odometry) -> None:
        position = odometry.pose.pose.position
        print(position.x, position.y, flush=True)

    node = rclpy.create_node("watcher")
    node.create_subscription(Odometry, "/odom", show, 10)
    rclpy.spin(node)


if __name__ == "__main__":
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with suppress(KeyboardInterrupt):
        _drive() if sys.argv[1] == "drive" else _watch()
