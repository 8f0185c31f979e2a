"""Texts that programs leave in a terminal when an error ends them: each program is really run."""

import functools
import linecache
import random
import sys
import sysconfig
import textwrap
import traceback
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import NamedTuple
from unittest.mock import patch

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from sim import run

CRASH, PAUSE = "/crash", 1.0  # s between two reports
WORKSPACE, HELPER_FILE = "/home/you/ws/", "shares.py"
MODULES = "install/{package}/lib/python3.12/site-packages/{package}/"
STARTED, ENDED = "[INFO] [{stamp:.6f}] [{name}]: ready", "[ros2run]: Process exited with failure 1"
RCLPY, PYTHON = str(Path(rclpy.__file__).parent), sysconfig.get_paths()["stdlib"]
ON_A_ROBOT = {RCLPY: "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy", PYTHON: "/usr/lib/python3.12"}
NAMES = (
    ("patrol", "driver"), ("dock", "charger"), ("arm", "reacher"), ("gate", "opener"), ("lamp", "blinker"),
    ("store", "counter"), ("tower", "watcher"), ("lift", "mover"),
)  # fmt: skip
SCRIPT = """\
import sys
from {package}.{name} import main
sys.exit(main())
"""
PROGRAM = """\
import json

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from {package}.shares import share

{constants}

class {kind}(Node):
    def __init__(self):
        super().__init__("{name}")
        self.declare_parameter("speed", 0.2)  # m/s
        self.limits, self.parts = {{"slow": 0.1}}, []
        self.publisher = self.create_publisher(String, "state", 10)
        self.create_timer(0.1, self.{callback})

    def {callback}(self):
{body}

def main():
    rclpy.init()
    rclpy.spin({kind}())
"""
HELPER = """\
{constants}

def share(whole, parts):
    return whole / len(parts)
"""
OWN = (
    "self.parts[0] += 1\n",
    "speed = self.spede + 0.1\n",
    "speed = 1.0 / len(self.parts)\nself.get_logger().info(f'{speed}')\n",
    "self.publisher.publish(String(data='at ' + 5))\n",
    "self.limits['fast'] += 0.1\n",
)
HANDLED = """\
try:
    speed = self.limits["fast"]
except KeyError:
    self.get_loger().warning("no limit")
"""
BODIES = {  # what goes wrong in the callback
    "own": OWN,
    "ended by ros2 run": OWN,
    "in a helper": ("share(1.0, self.parts)\n",),
    "in rclpy": ("self.publisher.publish('ready')\n",),
    "in rclpy, with a long text": ("self.create_publisher(String, 'my state', 10)\n",),
    "parameter": ("speed = self.get_parameter('sped').value\n",),
    "in Python's library": ("json.loads('{\"speed\": }')\n", "json.loads('')\n"),
    "after another error": (HANDLED,),
}


class CrashReport(NamedTuple):
    """A text, and what can be read in it: places as "driver.py:31", names of errors without their module.

    error: which one ended the program. place: of the lowest line in the workspace. above: of the other lines
    in the workspace. lowest: of the lowest line of all. handled: name and place of an earlier error, or none.
    """

    text: str
    error: str
    place: str
    above: tuple[str, ...]
    lowest: str
    handled: tuple[str, ...] = ()


@functools.cache
def crash_reports(seed: int) -> tuple[CrashReport, ...]:
    """Return a report of each kind, in an order that depends on the seed."""
    draw = random.Random(f"crashes {seed}")
    names = draw.sample(NAMES, len(BODIES))
    made = [_report(draw, kind, *name) for kind, name in zip(BODIES, names, strict=True)]
    return tuple(draw.sample(made, len(made)))


def crashes(seed: int) -> list[Callable[[], Node]]:
    """Return the program that publishes the reports of a seed."""
    return [functools.partial(CrashReporter, crash_reports(seed))]


class CrashReporter(Node):
    """Publishes one report (String on /crash) a second."""

    def __init__(self, reports: tuple[CrashReport, ...]) -> None:
        super().__init__("crash_reporter")
        left = [report.text for report in reversed(reports)]
        publisher = self.create_publisher(String, CRASH, 10)
        self.create_timer(PAUSE, lambda: publisher.publish(String(data=left.pop())) if left else None)


def _report(draw: random.Random, kind: str, package: str, name: str) -> CrashReport:
    modules = WORKSPACE + MODULES.format(package=package)
    named = {"package": package, "name": name, "kind": name.capitalize(), "constants": _constants(draw)}
    named["callback"] = draw.choice(["tick", "on_timer", "work"])
    body = textwrap.indent(draw.choice(BODIES[kind]), " " * 8)
    files = {
        f"{WORKSPACE}install/{package}/lib/{package}/{name}": SCRIPT.format(**named),
        f"{modules}{name}.py": PROGRAM.format(body=body, **named),
        f"{modules}{HELPER_FILE}": HELPER.format(constants=_constants(draw)),
    }
    whole = _run(files, package)
    *above, place = _own_places(whole)
    lines = [STARTED.format(stamp=draw.uniform(1.7e9, 1.8e9), name=name), *_lines(whole)]
    lines += [ENDED] if kind == "ended by ros2 run" or draw.random() < 0.4 else []
    context = None if whole.__suppress_context__ else whole.__context__
    handled = (_name(context), *_own_places(context)) if context else ()
    return CrashReport("\n".join(lines), _name(whole), place, tuple(above), _place(whole.stack[-1]), handled)


def _constants(draw: random.Random) -> str:
    """Lines that move what is below them."""
    values = [draw.randrange(1, 90) / 10 for _ in range(draw.randrange(1, 30))]
    return "".join(f"STEP_{number} = {value}\n" for number, value in enumerate(values, 1))


def _run(files: dict[str, str], package: str) -> traceback.TracebackException:
    """Run a program in a run of its own, and return the traceback of the error that ended it.

    files: paths and texts of the script that is started, of the program, and of its helper.
    """
    errors: list[traceback.TracebackException] = []
    script, program, helper = files

    def start() -> None:
        with patch.dict("sys.modules", {package: ModuleType(package)}):
            for path in (helper, program):
                module = ModuleType(f"{package}.{Path(path).stem}")
                sys.modules[module.__name__] = module
                exec(compile(files[path], path, "exec"), vars(module))
            try:
                exec(compile(files[script], script, "exec"), {})
            except Exception as error:
                errors.append(traceback.TracebackException.from_exception(error))

    with patch.dict(linecache.cache):
        for path, text in files.items():
            linecache.cache[path] = len(text), None, text.splitlines(keepends=True), path
        run(start, seconds=1, quiet=True, expect_error=True)
        return errors[0]


def _lines(whole: traceback.TracebackException) -> list[str]:
    """The traceback as Python prints it on a robot: without the simulation's frames."""
    part: traceback.TracebackException | None = whole
    while part is not None:
        part.stack[:] = [frame for frame in part.stack if _is_on_a_robot(frame)]
        part = part.__context__
    return "".join(whole.format()).splitlines()


def _is_on_a_robot(frame: traceback.FrameSummary) -> bool:
    """Return whether a robot has this frame, too. Gives it the path that it has there."""
    for here, there in ON_A_ROBOT.items():
        if frame.filename.startswith(here) and (here == RCLPY or "-packages" not in frame.filename):
            frame.filename = frame.filename.replace(here, there)
            return True
    return frame.filename.startswith(WORKSPACE)


def _own_places(whole: traceback.TracebackException) -> list[str]:
    return [_place(frame) for frame in whole.stack if frame.filename.startswith(WORKSPACE)]


def _name(whole: traceback.TracebackException) -> str:
    """The name of its error, without the module."""
    return next(iter(whole.format_exception_only())).partition(":")[0].strip().rpartition(".")[2]


def _place(frame: traceback.FrameSummary) -> str:
    return f"{Path(frame.filename).name}:{frame.lineno}"
