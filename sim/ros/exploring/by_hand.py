"""`schedule` lets a person take the executor's place: pick which of a node's callbacks continues next."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import Any

import rclpy

from sim.evidence import Recording
from sim.notebook import in_notebook, raise_if_outdated
from sim.ros.exploring.line_steps import Stop, in_lines, source_lines
from sim.ros.run import run

SIMPLE = bool | int | float | str | list | tuple | dict | set | None  # attributes that are shown
LONGEST = 60  # characters of a value that is shown
WAITING, RUNNING, BLOCKED, DONE = "waiting", "running", "blocked", "done"
DEADLOCK = "Each callback that isn't done waits for a lock that another one holds: a deadlock."
ENDLESS = "{}() doesn't go on: it loops, or waits inside a statement, where no other callback can run. Undo."

Holds = Callable[[Recording], bool]


@dataclass
class DueCallback:
    """One callback that is due. stop: the statement that comes next; None without threads, and at the end."""

    name: str
    arguments: tuple[Any, ...]
    state: str = WAITING
    stop: Stop | None = None
    steps: Generator[Stop, None, None] | None = None

    @property
    def line(self) -> int:
        """The line of the statement that comes next; 0 if there is none."""
        return self.stop.line if self.stop is not None else 0


@dataclass
class Position:
    """The state of the callbacks after some picks.

    choices: the numbers that can be picked next. done: what each pick ran, in words. values: the node's
    attributes. lines: the source of each call's method, with line numbers. holds: None until the end; then
    whether `holds` is true. text: the state in a sentence. refusal: why a callback can't be called, or "".
    unfinished: the callback that didn't end, or "".
    """

    calls: list[DueCallback] = field(default_factory=list)
    choices: list[int] = field(default_factory=list)
    done: list[str] = field(default_factory=list)
    values: dict[str, str] = field(default_factory=dict)
    lines: list[list[tuple[int, str]]] = field(default_factory=list)
    holds: bool | None = None
    text: str = ""
    refusal: str = ""
    unfinished: str = ""
    recording: Recording = field(default_factory=Recording)


class ByHand:
    """A node whose callbacks run in the order of `picks`; `position` is what that leads to.

    After each pick, the node is created anew in a run, and all picks are repeated.
    """

    def __init__(self, node: Callable[[], Any], calls: tuple[Any, ...], holds: Holds, threads: bool) -> None:
        self._node, self._holds, self.threads = node, holds, threads
        self._calls = [(each,) if isinstance(each, str) else tuple(each) for each in calls]
        self.picks: list[int] = []
        self.broken_after: list[int] = []
        self.position = self._replayed()

    def pick(self, number: int) -> Position:
        """Let the call of this number, from 1 on, continue. Raises ValueError if it can't."""
        if number not in self.position.choices:
            possible = " or ".join(map(str, self.position.choices)) or "none: undo, or start again"
            raise ValueError(f"{number} can't be picked now. Possible: {possible}.")
        self.picks.append(number)
        self.position = self._replayed()
        if self.position.holds is False:
            self.broken_after = list(self.picks)
        return self.position

    def undo(self) -> Position:
        """Take back the last pick, if there is one."""
        del self.picks[-1:]
        self.position = self._replayed()
        return self.position

    def restart(self) -> Position:
        """Take back all picks."""
        self.picks.clear()
        self.position = self._replayed()
        return self.position

    def __repr__(self) -> str:
        return self.position.text

    def _replayed(self) -> Position:
        """Run the node, with all picks so far."""
        found = Position()

        def main() -> None:
            rclpy.init()
            node = self._node()
            found.calls = [DueCallback(name, tuple(arguments)) for name, *arguments in self._calls]
            found.refusal = next(filter(None, (_refusal(node, call) for call in found.calls)), "")
            if found.refusal:
                return
            found.lines = [source_lines(getattr(node, call.name)) for call in found.calls]
            for call in found.calls if self.threads else ():
                call.steps = in_lines(getattr(node, call.name), *call.arguments)
                call.stop = next(call.steps, None)
            try:
                for number in self.picks:
                    call = found.calls[number - 1]
                    found.unfinished = call.name
                    found.done.append(self._continue(node, number, call))
                    found.unfinished = ""
            finally:
                found.values = _values(node)
                found.choices = self._choices(found.calls)
                for call in found.calls:
                    if call.steps is not None:
                        call.steps.close()

        recording = run(main, seconds=0.5, quiet=True, expect_error=True)
        if found.refusal:
            raise ValueError(found.refusal)
        if not found.lines and recording.errors:
            raise ValueError(f"The node can't be created: {recording.errors[0].text}")
        self._judge(found, recording)
        return found

    def _continue(self, node: Any, number: int, call: DueCallback) -> str:
        """Run a call's next statement, or all of it without threads; return what ran."""
        text, stop = f"{number} {call.name}()", call.stop
        call.state, call.stop = DONE, None  # if it fails, too
        if call.steps is None:
            getattr(node, call.name)(*call.arguments)
            return text
        call.stop = next(call.steps, None)
        call.state = DONE if call.stop is None else RUNNING
        return f"{text} line {stop.line}" if stop is not None else text

    def _choices(self, calls: list[DueCallback]) -> list[int]:
        """The numbers of the calls that can continue: one publisher's messages come in their order."""
        found = []
        for index, call in enumerate(calls):
            earlier = [each for each in calls[:index] if each.name == call.name]
            allowed = (WAITING,) if self.threads else (WAITING, RUNNING)
            too_early = call.state == WAITING and any(each.state in allowed for each in earlier)
            if call.stop is not None and call.stop.blocked:
                call.state = BLOCKED
            elif call.state in (WAITING, RUNNING) and not too_early:
                found.append(index + 1)
        return found

    def _judge(self, found: Position, recording: Recording) -> None:
        """Say how it is, and at the end whether it holds."""
        found.recording = recording
        if recording.errors:
            error = recording.errors[0]
            found.choices, found.holds = [], bool(self._holds(recording))
            found.text = f"{found.calls[self.picks[-1] - 1].name}() fails: {error.type}{error.says}"
        elif found.unfinished:
            found.choices, found.text = [], ENDLESS.format(found.unfinished)
        elif found.choices:
            found.text = f"Pick {' or '.join(map(str, found.choices))}."
        elif any(call.state == BLOCKED for call in found.calls):
            found.holds, found.text = False, DEADLOCK
        else:
            found.holds = bool(self._holds(recording))
            found.text = "All callbacks are done."
        if found.holds is not None:
            result = "It still holds. Try another order." if found.holds else "It doesn't hold: you broke it."
            found.text = f"{found.text} {result}"


def _refusal(node: Any, call: DueCallback) -> str:
    """Say why a callback can't be called as it is due; "" if it can."""
    method = getattr(node, call.name, None)
    if not callable(method):
        return f"The node has no method {call.name}()."
    if inspect.iscoroutinefunction(method) or inspect.isgeneratorfunction(method):
        return f"{call.name}() is async or has a yield: `schedule` runs callbacks that are ordinary methods."
    try:
        inspect.signature(method).bind(*call.arguments)
    except TypeError as error:
        return f"{call.name}() can't be called with what it is given: {error}."
    return ""


def _values(node: Any) -> dict[str, str]:
    """The node's own attributes that are numbers, strings, lists and the like."""
    own = {name: value for name, value in vars(node).items() if not name.startswith("_")}
    return {name: repr(value)[:LONGEST] for name, value in own.items() if isinstance(value, SIMPLE)}


def schedule(
    node: Callable[[], Any],
    *calls: Any,
    holds: Holds,
    threads: bool = False,
    watch: Callable[[Recording], str] | None = None,
) -> ByHand:
    """Let a person decide which of a node's callbacks runs next: in a notebook, with buttons and keys.

    node: a Node class, or a function that returns a Node. calls: the callbacks that are due, by name, such as
        "on_timer" or ("on_scan", scan), with what they are given. Of one callback, they stay in this order.
    holds: called with the recording when all have run, or one has failed; False means that it is broken.
    threads: callbacks run in parallel, so each pick runs only one statement of one. Otherwise, as in a
        SingleThreadedExecutor, it runs a whole callback.
    watch: returns a string about the run so far, which is shown: for example, the last command.

    Returns the game, which can also be played by its methods `pick`, `undo` and `restart`. Raises
    ValueError if there are no calls, one can't be called, or the node can't be created.
    """
    if not calls or not all(isinstance(each, str | tuple | list) and each for each in calls):
        raise ValueError('schedule needs callbacks that are due, such as "on_timer" or ("on_scan", scan).')
    raise_if_outdated((node,))
    game = ByHand(node, calls, holds, threads)
    if in_notebook():
        from sim.view.order_game import OrderGame  # imported here because it is slow

        OrderGame(game, watch).show()
    return game
