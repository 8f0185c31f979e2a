"""Reading a thread dump together with the program: which thread holds which lock, and what each waits for."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import NamedTuple

FRAME = re.compile(r'File "depot\.py", line (\d+) in (\w+)')
RESPONSE = "response"


class WaitingThread(NamedTuple):
    """A thread that waits in a callback: the locks that it holds, and the one, or the response, it needs."""

    callback: str
    holds: tuple[str, ...]
    needs: str


def waiting_threads(program: str, dump: str) -> list[WaitingThread]:
    """Return the threads of a dump that wait in a callback of this program."""
    withs = list(_withs(ast.parse(program), ()))
    found = []
    for thread in dump.split("\n\n"):
        frame = FRAME.search(thread)
        if frame is None or frame[2] == "main":
            continue
        line = int(frame[1])
        around = [lock for lock, begin, end in withs if begin < line <= end]
        needs = next((lock for lock, begin, _ in withs if begin == line), RESPONSE)
        found.append(WaitingThread(frame[2], tuple(around), needs))
    return found


def right_answers(program: str, dump: str) -> dict[str, str]:
    """Return the callback that holds each lock, and the one that waits for a response."""
    threads = waiting_threads(program, dump)
    held = {lock: thread.callback for thread in threads for lock in thread.holds}
    return held | {thread.needs: thread.callback for thread in threads if thread.needs == RESPONSE}


def _withs(node: ast.AST, outer: tuple[str, ...]) -> Iterator[tuple[str, int, int]]:
    """The locks that `with` takes, each with the line of the `with` and the last one of its block."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.With):
            for item in child.items:
                if isinstance(item.context_expr, ast.Attribute):
                    yield item.context_expr.attr, child.lineno, child.end_lineno or child.lineno
        yield from _withs(child, outer)
