"""Runs a student's test on programs that it is given as text, and publishes whether it passed."""

from __future__ import annotations

import contextlib
import io
import linecache
import threading
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from sim.ros.engine.preemption import Observer
from sim.ros.exploring import stopping_at_the_first
from sim.ros.fibers.scheduler import active

VERDICTS = "/verdicts"
PASSED, FAILED = "passed", "failed"
MOST_RUNS = 60  # of one program
MOST_SECONDS = 60.0  # of computing, after which no further program is tried: ten times what a test takes
MOST_TEXT = 160  # characters of why a test failed

Program = Callable[[], None]


def try_test(test: Any, sources: Sequence[Sequence[str]]) -> Callable[[], None]:
    """A `prepare` for scenarios: tries a test on programs, and makes a program that publishes the verdicts.

    test: a function of a program that `run` takes; it fails with any exception. sources: of each program its
    name and the text of its module, whose function `main` calls `started()` first; and for one that the
    student knows, the outcome without which no further ones are tried. A verdict is a String on /verdicts:
    the name, `passed` or `failed`, how often the program was started, how often the test has slept, and why
    it failed, or what it returned.
    """
    verdicts = _verdicts(test, sources)

    def publish_verdicts() -> None:
        if isinstance(verdicts, NotImplementedError):
            raise verdicts
        import rclpy
        from rclpy.node import Node
        from std_msgs.msg import String

        rclpy.init()
        node = Node("tester")
        publisher = node.create_publisher(String, VERDICTS, len(verdicts))
        for verdict in verdicts:
            publisher.publish(String(data=verdict))
        rclpy.spin(node)

    return publish_verdicts


def _verdicts(test: Any, sources: Sequence[Sequence[str]]) -> list[str] | NotImplementedError:
    """The verdicts on all programs; or the error of a test that isn't written yet."""
    found: list[str] = []
    begin = time.process_time()
    for name, text, *must in sources:
        try:
            found.append(_verdict(test, name, text))
        except NotImplementedError as error:
            return error
        late = time.process_time() - begin > MOST_SECONDS
        if late or (must and found[-1].split()[1] not in must):
            break
    return found


def _verdict(test: Any, name: str, text: str) -> str:
    """The verdict on a program. Raises NotImplementedError if the test does."""
    starts: list[int] = []
    sleeps: list[float] = []

    def started() -> None:
        starts.append(1)
        if len(starts) > MOST_RUNS:
            raise RuntimeError(f"a test runs each program at most {MOST_RUNS} times")

    program, outcome, reason = _program(name, text, started), PASSED, ""
    with (
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.redirect_stderr(io.StringIO()),
        _no_sleep(test, sleeps),
        stopping_at_the_first(),
        Observer().active(),
    ):
        try:
            returned = test(program)
            reason = "" if returned is None else f"returned {returned!r}"[:MOST_TEXT]
        except (KeyboardInterrupt, NotImplementedError):
            raise
        except BaseException as error:
            outcome, reason = FAILED, _reason(error)
    return f"{name} {outcome} {len(starts)} {len(sleeps)} {reason}".rstrip()


def _program(name: str, text: str, started: Callable[[], None]) -> Program:
    """The function `main` of a module with this text."""
    filename = f"<program {name}>"
    linecache.cache[filename] = len(text), None, text.splitlines(keepends=True), filename
    names: dict[str, Any] = {"__name__": f"program_{name}", "started": started}
    exec(compile(text, filename, "exec"), names)
    main: Program = names["main"]
    return main


@contextlib.contextmanager
def _no_sleep(test: Any, sleeps: list[float]) -> Iterator[None]:
    """In this block, `time.sleep` outside runs returns at once, and is noted.

    Other threads sleep on: Jupyter's kernel has one that looks every second whether its server still runs.
    """
    sleep, own = time.sleep, threading.get_ident()  # noqa: TID251 (it is replaced)

    def noted(seconds: float) -> None:
        if active() is None and threading.get_ident() == own:
            sleeps.append(seconds)
        else:
            sleep(seconds)

    places = [vars(time), getattr(test, "__globals__", {})]
    found = [(names, name) for names in places for name, value in list(names.items()) if value is sleep]
    for names, name in found:
        names[name] = noted
    try:
        yield
    finally:
        for names, name in found:
            names[name] = sleep


def _reason(error: BaseException) -> str:
    """Return what an error states, or the line that raised it."""
    text = str(error).strip().partition("\n")[0]
    if not text:
        frames = traceback.extract_tb(error.__traceback__)
        text = frames[-1].line or ""
    kind = "" if isinstance(error, AssertionError) else f"{type(error).__name__}: "
    return f"{kind}{text}"[:MOST_TEXT]
