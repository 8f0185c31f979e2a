"""What launch says: on the screen, in the log file, or wherever `elsewhere` leads it.

A launch file that is carried out writes `launch.log` into a folder of its own below $ROS_LOG_DIR, or
$ROS_HOME/log, or ~/.ros/log.
"""

from __future__ import annotations

import contextlib
import logging as python_logging
import os
import socket
import time
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from pathlib import Path
from typing import Any

Line = Callable[[int, str, str], None]  # level, name of the logger, text
_LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARNING", 40: "ERROR", 50: "CRITICAL"}


class LaunchConfig:
    """Where lines go to, and from which level on."""

    def __init__(self) -> None:
        self.level = python_logging.INFO
        self._log_dir: str | None = None

    @property
    def log_dir(self) -> str:
        """The folder of this launch, made when it is first asked for."""
        if self._log_dir is None:
            home = os.environ.get("ROS_HOME") or Path.home() / ".ros"
            base = Path(os.environ.get("ROS_LOG_DIR") or Path(home, "log"))
            now = time.time()
            stamp = time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(now)) + f"-{int(now % 1 * 1e6):06d}"
            folder = base / f"{stamp}-{socket.gethostname()}-{os.getpid()}"
            folder.mkdir(parents=True, exist_ok=True)
            self._log_dir = str(folder)
        return self._log_dir


launch_config = LaunchConfig()


def _to_screen(level: int, name: str, text: str) -> None:
    print(f"[{_LEVELS[level]}] [{name}]: {text}" if name else text, flush=True)


def _to_file(level: int, name: str, text: str) -> None:
    with Path(launch_config.log_dir, "launch.log").open("a", encoding="utf-8", errors="replace") as file:
        file.write(f"{time.time():.7f} [{_LEVELS[level]}] [{name}]: {text}\n" if name else f"{text}\n")


_elsewhere: ContextVar[Line | None] = ContextVar("elsewhere", default=None)


@contextlib.contextmanager
def elsewhere(line: Line) -> Iterator[None]:
    """Let lines of what is launched in here go to `line`, and neither to the screen nor to a file."""
    token = _elsewhere.set(line)
    try:
        yield
    finally:
        _elsewhere.reset(token)


class Logger:
    """Says lines under a name."""

    def __init__(self, name: str) -> None:
        self.name = name

    def debug(self, msg: str) -> None:
        """What only helps to look for mistakes."""
        self._say(python_logging.DEBUG, msg)

    def info(self, msg: str) -> None:
        """What happens."""
        self._say(python_logging.INFO, msg)

    def warning(self, msg: str) -> None:
        """What may be wrong."""
        self._say(python_logging.WARNING, msg)

    def error(self, msg: str) -> None:
        """What is wrong."""
        self._say(python_logging.ERROR, msg)

    def _say(self, level: int, msg: str) -> None:
        if level < launch_config.level:
            return
        for line in [_elsewhere.get()] if _elsewhere.get() is not None else [_to_screen, _to_file]:
            line(level, self.name, str(msg))


def get_logger(name: str | None = None) -> Logger:
    """The logger of this name."""
    return Logger(name or "root")


def log_launch_config(*, logger: Logger) -> None:
    """Say where the log file is, and from which level on lines are shown."""
    if _elsewhere.get() is None:
        logger.info(f"All log files can be found below {launch_config.log_dir}")
        logger.info(f"Default logging verbosity is set to {_LEVELS[launch_config.level]}")


def output_destinations(output: Any) -> dict[str, list[Callable[[str], None]]]:
    """Where lines of a program's "stdout" and "stderr" go to, by the `output` of its action.

    Raises ValueError for what is none.
    """
    named = {"screen": ("screen", "screen"), "log": ("log", "log screen"), "both": ("log screen",) * 2}
    named |= {"own_log": ("log", "log"), "full": ("log screen",) * 2}
    if isinstance(output, dict):
        both = output.get("both", ())
        wanted = {}
        for stream in ("stdout", "stderr"):
            own = output.get(stream, ())
            wanted[stream] = {*([own] if isinstance(own, str) else own)}
            wanted[stream] |= {*([both] if isinstance(both, str) else both)}
    elif output in named:
        wanted = {
            stream: set(to.split()) for stream, to in zip(("stdout", "stderr"), named[output], strict=True)
        }
    else:
        raise ValueError(f'{output} is not a valid standard output config i.e. "screen", "log" or "both"')
    if _elsewhere.get() is not None:  # what programs write is there already
        return {"stdout": [], "stderr": []}
    return {
        stream: [
            *([lambda text: _to_screen(20, "", text)] if "screen" in to else []),
            *([lambda text: _to_file(20, "", text)] if to & {"log", "own_log"} else []),
        ]
        for stream, to in wanted.items()
    }
