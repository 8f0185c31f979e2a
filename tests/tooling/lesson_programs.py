"""A lesson's programs as real processes: what its cells define, without sim, in a domain that a robot shares.

    python -m tests.tooling.lesson_programs JSON

Runs as a process of its own: together() gets what to run, and what it returns is printed as one line of
JSON. Each program is a fork, for a fresh interpreter would take a second to import the messages.
"""

from __future__ import annotations

import ast
import functools
import importlib
import json
import operator
import os
import re
import select
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn

from tests.patience import until

ROOT = Path(__file__).resolve().parents[2]
OWN = ("sim", "grader", "ipywidgets")  # what a robot doesn't have


def notebook_file(lesson: str) -> Path:
    """The notebook of a lesson, such as "01_nodes"; of one with several, such as "04_actions/driving"."""
    return ROOT / "course" / (f"{lesson}.ipynb" if "/" in lesson else f"{lesson}/lesson.ipynb")


def definitions(lesson: str) -> str:
    """What the cells of a lesson define, as a module: no runs, and nothing that needs our packages."""
    file = notebook_file(lesson)
    folder = file.parent
    notebook = json.loads(file.read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    written = {cell.split()[1].removesuffix(".py") for cell in cells if cell.startswith("%%writefile")}
    missing, kept, own = {"print", "display", *written}, [], set()
    for cell in cells:
        plain = "" if cell.startswith("%%") else re.sub("^[%!].*", "", cell, flags=re.M)
        for statement in ast.parse(plain).body:
            if _is_own(statement, folder):
                own |= set(_defined(statement))
            if _is_own(statement, folder) or missing & set(_needed(statement)) or _runs(statement, own):
                missing |= set(_defined(statement))
            elif not isinstance(statement, ast.Expr | ast.For | ast.If | ast.With) or _adds_folder(statement):
                kept.append(statement)
    return ast.unparse(ast.Module(kept, []))


def _adds_folder(statement: ast.stmt) -> bool:
    """Whether it adds the folder of another lesson, whose modules are imported next."""
    return ast.unparse(statement).startswith("sys.path.append(")


def _is_own(statement: ast.stmt, folder: Path) -> bool:
    """Whether it imports from our packages, or from a module beside the lesson that does."""
    if isinstance(statement, ast.ImportFrom):
        modules = [statement.module or ""]
    else:
        modules = [name.name for name in statement.names] if isinstance(statement, ast.Import) else []
    return any(module.split(".")[0] in OWN or _imports_own(folder / f"{module}.py") for module in modules)


def _imports_own(file: Path) -> bool:
    """Whether a module beside a lesson, if there is such a file, imports from our packages."""
    statements = ast.parse(file.read_text(encoding="utf-8")).body if file.exists() else []
    return any(_is_own(statement, file.parent) for statement in statements)


def _runs(statement: ast.stmt, own: set[str]) -> bool:
    """Whether it is a function that works with the course's names; a cell that calls it runs a simulation."""
    names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
    return isinstance(statement, ast.FunctionDef) and bool(own & names)


def _needed(statement: ast.stmt) -> Iterator[str]:
    """The names that a statement looks up when it runs; what functions look up comes later."""
    pending: list[ast.AST] = [statement]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            pending += [*node.decorator_list, *node.args.defaults]
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            yield node.id
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        else:
            pending += ast.iter_child_nodes(node)


def _defined(statement: ast.stmt) -> Iterator[str]:
    if isinstance(statement, ast.ImportFrom | ast.Import):
        yield from (name.asname or name.name for name in statement.names)
    elif isinstance(statement, ast.FunctionDef | ast.ClassDef):
        yield statement.name
    else:
        yield from (
            node.id
            for node in ast.walk(statement)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        )


def lesson(name: str) -> dict[str, Any]:
    """The names that a lesson defines, in this process."""
    folder = notebook_file(name).parent
    os.chdir(folder)
    sys.path.insert(0, str(folder))
    found: dict[str, Any] = {"__name__": "lesson"}
    exec(compile(definitions(name), f"{name}.ipynb", "exec"), found)
    return found


class Program:
    """A fork that runs a main() or a node class."""

    def __init__(self, found: dict[str, Any], program: dict[str, Any], errors: Path) -> None:
        self._spins, spins = os.pipe()
        self.number = os.fork()
        if not self.number:
            _run_and_exit(found, program, errors, spins)
        os.close(spins)

    def wait_until_it_spins(self) -> None:
        """Or until it has ended without."""
        self._wait()

    def wait_until_it_ends(self) -> None:
        """By itself."""
        while self._wait():
            pass

    def _wait(self) -> bytes:
        until(lambda: select.select([self._spins], [], [], 0)[0], "a program of the lesson")
        return os.read(self._spins, 1)

    def end(self, number: int) -> int | str:
        """Send it a signal; its exit status, or that it hung."""
        os.kill(self.number, number)
        try:
            return os.waitstatus_to_exitcode(until(self._statuses)[0])
        except AssertionError:
            os.kill(self.number, signal.SIGKILL)
            os.waitpid(self.number, 0)
            return "hung"

    def _statuses(self) -> list[int]:
        number, status = os.waitpid(self.number, os.WNOHANG)
        return [status] if number else []


def _run_and_exit(found: dict[str, Any], program: dict[str, Any], errors: Path, spins: int) -> NoReturn:
    """In the fork. spins: gets a byte when an executor spins; from then on the program handles signals."""
    os.dup2(os.open(errors, os.O_WRONLY | os.O_CREAT | os.O_APPEND), 2)
    os.dup2(2, 1)
    # As in a terminal. What a shell's script starts with `&` ignores it, and so do all its children.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    status = 1
    try:
        _report_spinning(spins, program.get("subscribers", {}))
        _run(_named(found, program["name"]), program.get("arguments"))
        status = 0
    except BaseException:
        import traceback

        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(status)


def _report_spinning(spins: int, subscribers: dict[str, int]) -> None:
    """Before the first wait of an executor, which is also for so many subscribers of topics."""
    from rclpy.executors import Executor

    wait = Executor.wait_for_ready_callbacks

    def report_and_wait(executor: Executor, *arguments: Any, **more: Any) -> Any:
        Executor.wait_for_ready_callbacks = wait
        os.write(spins, b"x")
        for topic, count in subscribers.items():
            (node,) = executor.get_nodes()
            until(lambda: node.count_subscribers(topic) >= count, f"subscribers of {topic}")  # noqa: B023
        return wait(executor, *arguments, **more)

    Executor.wait_for_ready_callbacks = report_and_wait


def _named(found: dict[str, Any], name: str) -> Any:
    first, *rest = name.split(".")
    thing = found[first] if first in found else importlib.import_module(first)
    for attribute in rest:
        thing = getattr(thing, attribute)
    return thing


def _run(thing: Any, arguments: list[str] | None) -> None:
    """Run a main(), or a node class as the main() of lesson 1 does."""
    import rclpy
    from rclpy.executors import ExternalShutdownException

    if not isinstance(thing, type):
        thing(*([["", "--ros-args", *arguments]] if arguments else []))
        return
    rclpy.init(args=["", "--ros-args", *arguments] if arguments else None)
    node = thing()  # and from here on as the main() of lesson 1
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


class Listener:
    """Receives topics, in this process: of each message, one number."""

    def __init__(self, topics: dict[str, tuple[str, str]]) -> None:
        import rclpy

        rclpy.init()
        self._node = rclpy.create_node("lesson_listener")
        self.received: dict[str, list[float]] = {topic: [] for topic in topics}
        for topic, (kind, field) in topics.items():
            package, _, name = kind.split("/")
            message_type = getattr(importlib.import_module(f"{package}.msg"), name)
            keep = functools.partial(self._keep, topic, operator.attrgetter(field))
            self._node.create_subscription(message_type, topic, keep, 10)  # reliable, as the robot's

    def _keep(self, topic: str, number_of: Callable[[Any], float], message: Any) -> None:
        self.received[topic].append(number_of(message))

    def listen_until(self, condition: str, errors: Path) -> None:
        """Until a Python expression of what was `received` and of the text of `errors` is true."""
        import rclpy

        def holds() -> bool:
            rclpy.spin_once(self._node, timeout_sec=0.05)
            return eval(condition, {"received": self.received, "errors": errors.read_text(encoding="utf-8")})

        until(holds, condition)


def together(spec: dict[str, Any]) -> dict[str, Any]:
    """Run programs side by side; how each of them ended, what they complained of, and what they received.

    They get their signal when all spin, each topic had a message and the condition `until` is true; what is
    received afterwards makes `at_end` true. alone: they are to end without a signal.
    """
    found, errors = lesson(spec["lesson"]), Path(spec["errors"])
    errors.touch()
    programs = [Program(found, program, errors) for program in spec["programs"]]
    listener = Listener(spec["listen"])
    for program in programs:
        program.wait_until_it_ends() if spec["alone"] else program.wait_until_it_spins()
    listener.listen_until("all(received.values())", errors)
    listener.listen_until(spec["until"], errors)
    statuses = [program.end(signal.Signals[spec["signal"]]) for program in programs]
    listener.listen_until(spec["at_end"], errors)
    return {"ended": statuses, "errors": errors.read_text(encoding="utf-8"), "received": listener.received}


if __name__ == "__main__":
    wanted = json.loads(sys.argv[1])
    print(json.dumps(together(wanted)))
