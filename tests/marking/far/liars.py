"""Workers that don't mark, for tests of what is made of their answers."""
import os
from typing import Any

from grader.marking.far.worker import work
from grader.marking.result import Result


def nonsense(order: dict[str, Any]) -> tuple[str, str]:
    return "marked", "{}"


def number(order: dict[str, Any]) -> tuple[str, object]:
    return "marked", 100


def other(order: dict[str, Any]) -> tuple[str, str]:
    task = order["task"] | {"student": "somebody else"}
    return "marked", Result(**task, verdict="marked").to_json()


def crash(order: dict[str, Any]) -> tuple[str, str]:
    raise ValueError("a worker's own mistake")


def failed(order: dict[str, Any]) -> tuple[str, str]:
    return "failed", "OSError: No space left on device"


def fails_at_first(first: str, order: dict[str, Any]) -> tuple[str, str]:
    """Fails in every process but the second that is asked; the file `first` tells them apart."""
    with open(first, "a+") as file:
        file.seek(0)
        asked = file.read() or str(os.getpid())
        file.truncate(0)
        file.write(asked)
    return failed(order) if asked == str(os.getpid()) else work(order)
