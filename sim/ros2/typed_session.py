"""What was typed in several terminals, as a program of a run that types it again.

No shell is started: a few commands are recognized, and the others are reported as a shell would do it.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from sim.nanoseconds import SECOND
from sim.ros.engine.program import Process
from sim.ros.fibers.scheduler import engine
from sim.ros.launching.respawned import interrupt
from sim.ros2.cli_program import execute_words
from sim.ros2.domains import COURSE_DOMAIN
from sim.ros2.typed_corrections import corrected
from sim.ros2.typed_lines import InvalidLine, Line, lines_of, words_of
from sim.ros2.typed_workspace import WORKSPACE, TypedWorkspace
from sim.suggestions import closest_match

SETUP = re.compile(rf"(?:.*/)?(?<!\b{WORKSPACE}/){WORKSPACE}/install/(?:local_)?setup\.(?:bash|sh|zsh)")
OTHER_SETUP = re.compile(r"/opt/ros/\w+/setup\.\w+|.*/bin/activate")
CTRL_C = re.compile(r"ctrl\W?c(?:\s+after\s+(\d+(?:\.\d+)?)\s*s?)?", re.IGNORECASE)
ASSIGNMENT = re.compile(r"([A-Za-z_]\w*)=(.*)", re.DOTALL)
ROBOT = re.compile(r"python\S* -m sim\b(?:.*\s--domain[ =](\d+))?.*")
ALONE = "interface", "pkg"  # commands of ros2 that look for no node
OF_PROGRAMS = "launch", "run"
OF_PACKAGES = *OF_PROGRAMS, "pkg"
TYPING, LONG = 1.0, 10.0  # s: for each line; until a wait is reported


@dataclass
class Terminal:
    """A terminal: its folder and variables, and the program that was started there last, by which line.

    sourced: the packages that were built when it sourced the workspace. lasts: it is one that a person leaves
    running. robot: it is `python -m sim`: the run has its robot.
    """

    folder: str = ""
    variables: dict[str, str] = field(default_factory=dict)
    sourced: frozenset[str] = frozenset()
    program: Any = None
    line: int = 0
    lasts: bool = False
    robot: bool = False


def terminals(text: str, prefix: Path) -> Process:
    """A program for `run` that types commands, as `lines_of` reads them, each in its terminal.

    Each takes 1 s to type, and waits until the one before in its terminal has ended.
    prefix: the install prefix of the workspace. Its packages are found in terminals that source it, once
    `colcon build` was typed.
    """

    def terminals() -> None:  # the program's name
        TypedSession(prefix).type(list(lines_of(text)))

    return Process(terminals)


class TypedSession:
    """Types commands in terminals; prints each, and what is wrong with it. prefix: as for `terminals`."""

    def __init__(self, prefix: Path) -> None:
        self._run = engine()
        self._spec = self._run.current.process.spec
        self._prefix = prefix
        self._workspace, self._domain = TypedWorkspace(prefix), str(COURSE_DOMAIN)
        self._commands: dict[str, Callable[[Line, Terminal, list[str]], None]] = {
            "cd": self._cd,
            "source": self._source,
            ".": self._source,
            "export": self._export,
            "sleep": self._sleep,
            "colcon": self._colcon,
            "ros2": self._ros2,
            **dict.fromkeys(("clear", "ls", "pwd"), lambda *_: None),
        }

    def type(self, lines: list[Line]) -> None:
        """Type these lines, and wait until all programs have ended."""
        used: dict[str, Terminal] = {}
        lines = list(corrected(lines, self._prefix)) if self._spec.lenient else lines
        for line in lines:
            self._wait(TYPING)
            self._type(line, used.setdefault(line.terminal, Terminal()))
        for terminal in used.values():
            self._wait_for_end(terminal)

    def _type(self, line: Line, terminal: Terminal) -> None:
        try:
            if pressed := CTRL_C.fullmatch(line.text):
                self._wait(float(pressed[1] or 0.0))
                self._show(line)
                self._interrupt(terminal)
            else:
                self._wait_for_prompt(line, terminal)
                self._show(line)
                self._execute(line, terminal)
        except InvalidLine as reason:
            print(reason)
            _report_failure(line)

    def _show(self, line: Line) -> None:
        print(f"terminal {line.terminal}, line {line.number} $ {line.text}")

    def _execute(self, line: Line, terminal: Terminal) -> None:
        if started := ROBOT.fullmatch(line.text):
            terminal.robot, self._domain = True, started[1] or str(COURSE_DOMAIN)
            return
        words, before = words_of(line.text), terminal.variables
        while words and ASSIGNMENT.fullmatch(words[0]):
            self._export(line, terminal, ["export", words.pop(0)])
        if not words:
            return
        if words[0] not in self._commands:
            near = closest_match(words[0], self._commands)
            raise InvalidLine(f"{words[0]}: command not found{f'. Did you mean {near}?' if near else ''}")
        try:
            self._commands[words[0]](line, terminal, words)
        finally:
            if words[0] != "export":
                terminal.variables = before

    # -- waiting -----------------------------------------------------------------------------------

    def _wait(self, seconds: float | None, ready: Callable[[], bool] | None = None) -> None:
        until = None if seconds is None else self._run.now + round(seconds * SECOND)
        self._run.wait("the terminal", ready=ready, until=until)

    def _is_running(self, terminal: Terminal) -> bool:
        return terminal.program is not None and self._run.lives(terminal.program)

    def _wait_for_end(self, terminal: Terminal, seconds: float | None = None) -> None:
        if self._is_running(terminal):
            self._wait(seconds, lambda: not self._is_running(terminal))

    def _wait_for_prompt(self, line: Line, terminal: Terminal) -> None:
        if terminal.robot:
            self._show(line)
            raise InvalidLine(f"python -m sim is running in terminal {line.terminal}: open another one")
        self._wait_for_end(terminal, LONG)
        if self._is_running(terminal):
            self._show(line)
            print(f"line {terminal.line} is still running in terminal {line.terminal}")
            _report_failure(line)
            if not terminal.lasts:  # it waits for what isn't there, or goes on: a person ends it
                self._interrupt(terminal)
            self._wait_for_end(terminal)

    def _interrupt(self, terminal: Terminal) -> None:
        terminal.robot = False
        if self._is_running(terminal):
            interrupt(terminal.program)
            self._wait_for_end(terminal)

    # -- commands ----------------------------------------------------------------------------------

    def _cd(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        terminal.folder = self._path(terminal, (*words[1:], "~")[0])

    def _path(self, terminal: Terminal, path: str) -> str:
        return posixpath.normpath(path if path.startswith("~") else posixpath.join(terminal.folder, path))

    def _source(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        path = self._path(terminal, (*words[1:], "")[0])
        if SETUP.fullmatch(path) and self._workspace.built:
            terminal.sourced = frozenset(self._workspace.built)
        elif not OTHER_SETUP.fullmatch(path):
            reason = "colcon build makes it" if SETUP.fullmatch(path) else "cd to the right folder first"
            raise InvalidLine(f"bash: {' '.join(words[1:])}: No such file or directory: {reason}")

    def _export(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        given = {found[1]: found[2] for found in map(ASSIGNMENT.fullmatch, words[1:]) if found}
        terminal.variables = {**terminal.variables, **given}

    def _sleep(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        text = " ".join(words[1:])
        if not re.fullmatch(r"\d+(\.\d+)?s?", text):
            raise InvalidLine(f"sleep: invalid time interval '{text}'")
        self._wait(float(text.removesuffix("s")))

    def _colcon(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        if words[1:2] != ["build"]:
            raise InvalidLine(f"{' '.join(words[:2])} is not executed here: colcon build is")
        self._workspace.build(terminal.folder, words)

    def _ros2(self, line: Line, terminal: Terminal, words: list[str]) -> None:
        if words[1:3] == ["pkg", "create"]:
            self._workspace.create(terminal.folder, words)
            return
        if words[1:2] and words[1] in OF_PACKAGES:
            self._workspace.require(terminal.sourced, words[2:])
        self._require_domain(terminal, words)
        spec = self._spec

        def ros2() -> Process | None:  # the program's name
            started = execute_words(words)
            if isinstance(started, Process):
                rules = () if words[1] == "launch" else spec.remappings
                words_of_rules = [word for old, new in rules for word in ("-r", f"{old}:={new}")]
                before = ["--ros-args", *words_of_rules, "--"] if rules else []  # the first rule counts
                return replace(started, arguments=[*before, *started.arguments])
            if started:
                _report_failure(line)
            return None

        ros2.bundled, terminal.line, terminal.lasts = True, line.number, (*words, "")[1] in OF_PROGRAMS  # type: ignore[attr-defined]
        terminal.program = self._run.start(replace(spec, target=ros2, arguments=()))

    def _require_domain(self, terminal: Terminal, words: list[str]) -> None:
        """Raise InvalidLine if the command would look for nodes where the robot is not."""
        domain = terminal.variables.get("ROS_DOMAIN_ID") or "0"
        if len(words) > 1 and words[1] not in ALONE and domain != self._domain:
            raise InvalidLine(
                f"There are no nodes on ROS domain {domain}, but on {self._domain}:"
                f" export ROS_DOMAIN_ID={self._domain}"
            )


def _report_failure(line: Line) -> None:
    """Print that a line failed, below the reason."""
    print(f"[line {line.number} failed]")
