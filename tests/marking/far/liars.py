"""Workers that don't mark, for tests of what is made of their answers."""
import os
from typing import Any

from grader.marking.result import Result


def nonsense(order: dict[str, Any]) -> tuple[str, str]:
    return "marked", "{}"


def number(order: dict[str, Any]) -> tuple[str, object]:
    return "marked", 100


def other(order: dict[str, Any]) -> tuple[str, str]:
    return _marked(order, student="somebody else")


def looks(order: dict[str, Any]) -> tuple[str, str]:
    """Says what came of the submission and of the release."""
    parcels = (order["submission"], order["release"])
    return _marked(order, reason=", ".join(" ".join(item["path"] for item in some[1:]) for some in parcels))


def crash(order: dict[str, Any]) -> tuple[str, str]:
    raise ValueError("a worker's own mistake")


def failed(order: dict[str, Any]) -> tuple[str, str]:
    return "failed", "OSError: No space left on device"


def fails_at_first(first: str, order: dict[str, Any]) -> tuple[str, str]:
    """Fails in the process that is asked first, which the file `first` names."""
    with open(first, "a+") as file:
        file.seek(0)
        asked = file.read() or str(os.getpid())
        file.truncate(0)
        file.write(asked)
    return failed(order) if asked == str(os.getpid()) else _marked(order)


def _marked(order: dict[str, Any], **changes: str) -> tuple[str, str]:
    return "marked", Result(**{**order["task"], "verdict": "marked", **changes}).to_json()
