"""Programs that only show something in a window: launch files leave them out with a warning, and go on."""

from __future__ import annotations

import contextlib
import re
import sys
import threading
from collections.abc import Callable

from sim.absent_packages import explain
from sim.ros.packages import bundled_command, executables, packages

_WINDOWS = re.compile(r"rviz2?|rqt(_\w+)?|plotjuggler|foxglove_bridge|joint_state_publisher_gui")


def is_left_out(package: str, name: str) -> bool:
    """Return whether a launch file leaves out this program: it only shows something and isn't installed."""
    window = _WINDOWS.fullmatch(package)
    return window is not None and not (package in packages() and name in executables(package))


def left_out(package: str) -> Callable[[], None]:
    """A main() function in the place of such a program: it warns, and waits for its end as a window does."""

    def main() -> None:
        from rclpy.logging import get_logger  # imported late: a terminal's command needs rclpy only for this

        why = explain(package) or f"`{package}` only shows something in a window, and the course has none."
        get_logger("launch").warning(f"{package} is left out. {why}")
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()

    main.__name__ = package
    main.bundled = True  # type: ignore[attr-defined]
    return main


def command_of_launch(package: str, name: str) -> list[str] | None:
    """Work like `bundled_command`, for launch files of a terminal."""
    if is_left_out(package, name):
        return [sys.executable, "-m", "sim.ros.left_out", package]
    return bundled_command(package, name)


if __name__ == "__main__":
    left_out(sys.argv[1])()
