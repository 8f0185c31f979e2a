"""The log of launch: on the screen and in a log file, unless `redirect_log` sends it to a function.

The log file is `launch.log` in a new folder in $ROS_LOG_DIR, $ROS_HOME/log or ~/.ros/log.
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

WriteLine = Callable[[int, str, str], None]  # level, name of the logger, text
_LEVELS = {10: "DEBUG", 20: "INFO", 30: "WARNING", 40: "ERROR", 50: "CRITICAL"}


class LaunchConfig:
    """The log folder, and the lowest level that is logged."""

    def __init__(self) -> None:
        self.level = python_logging.INFO
        self._log_dir: str | None = None

    @property
    def log_dir(self) -> str:
        """The log folder of this launch, which is created on first use."""
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


def _write_to_screen(level: int, name: str, text: str) -> None:
    print(f"[{_LEVELS[level]}] [{name}]: {text}" if name else text, flush=True)


def _write_to_file(level: int, name: str, text: str) -> None:
    with Path(launch_config.log_dir, "launch.log").open("a", encoding="utf-8", errors="replace") as file:
        file.write(f"{time.time():.7f} [{_LEVELS[level]}] [{name}]: {text}\n" if name else f"{text}\n")


_redirected_to: ContextVar[WriteLine | None] = ContextVar("redirected_to", default=None)


@contextlib.contextmanager
def redirect_log(write: WriteLine) -> Iterator[None]:
    """Within this context, pass all lines to `write` instead of the screen and the log file."""
    token = _redirected_to.set(write)
    try:
        yield
    finally:
        _redirected_to.reset(token)


class Logger:
    """Logs lines under a name."""

    def __init__(self, name: str) -> None:
        self.name = name

    def debug(self, msg: str) -> None:
        """Log a line that only helps with debugging."""
        self._log(python_logging.DEBUG, msg)

    def info(self, msg: str) -> None:
        """Log a line about normal operation."""
        self._log(python_logging.INFO, msg)

    def warning(self, msg: str) -> None:
        """Log a line about a possible problem."""
        self._log(python_logging.WARNING, msg)

    def error(self, msg: str) -> None:
        """Log a line about an error."""
        self._log(python_logging.ERROR, msg)

    def _log(self, level: int, msg: str) -> None:
        if level < launch_config.level:
            return
        redirected_to = _redirected_to.get()
        for write in [_write_to_screen, _write_to_file] if redirected_to is None else [redirected_to]:
            write(level, self.name, str(msg))


def get_logger(name: str | None = None) -> Logger:
    """The logger with this name."""
    return Logger(name or "root")


def log_launch_config(*, logger: Logger) -> None:
    """Log where the log folder is and which level is logged."""
    if _redirected_to.get() is None:
        logger.info(f"All log files can be found below {launch_config.log_dir}")
        logger.info(f"Default logging verbosity is set to {_LEVELS[launch_config.level]}")


def output_destinations(output: Any) -> dict[str, list[Callable[[str], None]]]:
    """The functions that write the lines of a process's "stdout" and "stderr", by the `output` of its action.

    Raises ValueError for an unknown `output`.
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
    if _redirected_to.get() is not None:  # the output is there already
        return {"stdout": [], "stderr": []}
    return {
        stream: [
            *([lambda text: _write_to_screen(20, "", text)] if "screen" in to else []),
            *([lambda text: _write_to_file(20, "", text)] if to & {"log", "own_log"} else []),
        ]
        for stream, to in wanted.items()
    }
