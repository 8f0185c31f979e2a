"""Keys become velocity commands on cmd_vel: the keys, the parameters and the speeds are upstream's.

Upstream needs a terminal. This program takes its keys from a pipe or a run's `stdin`, too: there it presses
one each half second, and ends after the last.
"""

from __future__ import annotations

import contextlib
import io
import sys
import termios
import threading
import tty
from collections.abc import Callable, Iterator

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

Direction = tuple[float, float, float, float]  # shares of the speed to x, y and z, and of the turn about z

MOVES: dict[str, Direction] = {
    "u": (1, 0, 0, 1), "i": (1, 0, 0, 0), "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1), "l": (0, 0, 0, -1),
    "m": (-1, 0, 0, -1), ",": (-1, 0, 0, 0), ".": (-1, 0, 0, 1),
    "U": (1, 1, 0, 0), "I": (1, 0, 0, 0), "O": (1, -1, 0, 0),
    "J": (0, 1, 0, 0), "L": (0, -1, 0, 0),
    "M": (-1, 1, 0, 0), "<": (-1, 0, 0, 0), ">": (-1, -1, 0, 0),
    "t": (0, 0, 1, 0), "b": (0, 0, -1, 0),
}  # fmt: skip
FACTORS = {
    "q": (1.1, 1.1), "z": (0.9, 0.9),
    "w": (1.1, 1.0), "x": (0.9, 1.0),
    "e": (1.0, 1.1), "c": (1.0, 0.9),
}  # fmt: skip
SPEED, TURN = 0.5, 1.0  # m/s and rad/s at the start
PAUSE = Duration(seconds=0.5)  # between two keys without a terminal
CTRL_C = "\x03"
HELP = """
Moving around:             With Shift, for a robot that can drive sideways:
   u    i    o                U    I    O
   j    k    l                J    K    L
   m    ,    .                M    <    >

t / b : up / down; any other key: stop
q / z : both speeds by 10 % up / down
w / x : only the linear speed
e / c : only the angular speed
Ctrl-C ends it.
"""


class TeleopTwistKeyboard(Node):
    """Publishes a command for each key. Parameters: `stamped`, for TwistStamped, and its `frame_id`."""

    def __init__(self) -> None:
        super().__init__("teleop_twist_keyboard")
        self._stamped = self.declare_parameter("stamped", False).value
        self._frame = self.declare_parameter("frame_id", "").value
        if self._frame and not self._stamped:
            raise ValueError("'frame_id' can only be set when 'stamped' is True")
        self._publisher = self.create_publisher(TwistStamped if self._stamped else Twist, "cmd_vel", 10)
        self._speed, self._turn, self._direction = SPEED, TURN, (0.0, 0.0, 0.0, 0.0)

    def press(self, key: str) -> None:
        """Change the speeds or the direction, and publish."""
        if key in FACTORS:
            linear, angular = FACTORS[key]
            self._speed, self._turn = self._speed * linear, self._turn * angular
            print(f"currently:\tspeed {self._speed:.3g}\tturn {self._turn:.3g}")
        else:
            self._direction = MOVES.get(key, (0.0, 0.0, 0.0, 0.0))
        command, (x, y, z, turn) = Twist(), self._direction
        command.linear.x, command.linear.y, command.linear.z = (share * self._speed for share in (x, y, z))
        command.angular.z = turn * self._turn
        if self._stamped:
            stamped = TwistStamped(twist=command)
            stamped.header.stamp, stamped.header.frame_id = self.get_clock().now().to_msg(), self._frame
            self._publisher.publish(stamped)
        else:
            self._publisher.publish(command)

    def pause(self) -> None:
        """Wait until the next key of a text."""
        self.get_clock().sleep_for(PAUSE)


def keys(pause: Callable[[], None]) -> Iterator[str]:
    """The keys that are pressed: in a terminal without Enter; elsewhere the characters of each line."""
    try:
        settings = termios.tcgetattr(sys.stdin)
    except (termios.error, io.UnsupportedOperation):
        for key in (key for line in sys.stdin for key in line.rstrip("\n")):
            yield key
            pause()
        return
    while True:
        tty.setraw(sys.stdin.fileno())
        try:
            key = sys.stdin.read(1)
        finally:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
        yield key


def main() -> None:
    """Drive until Ctrl-C, or until the text ends; then stop the robot."""
    rclpy.init()
    node, executor = TeleopTwistKeyboard(), SingleThreadedExecutor()
    executor.add_node(node)
    spinner = threading.Thread(target=_spin, args=(executor,))
    spinner.start()
    print(HELP)
    try:
        for key in keys(node.pause):
            if key in ("", CTRL_C):
                break
            node.press(key)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        if rclpy.ok():
            node.press("k")
        executor.shutdown()
        spinner.join()
        rclpy.try_shutdown()


def _spin(executor: SingleThreadedExecutor) -> None:
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
