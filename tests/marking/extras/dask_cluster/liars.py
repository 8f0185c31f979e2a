"""Workers that don't mark, for tests of what is made of their answers."""
import os
from dataclasses import replace

from grader.marking.extras.dask_cluster.on_worker import RunSettings
from grader.marking.result import Result
from grader.marking.task import MarkingTask


def nonsense(how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    return "marked", "{}"


def number(how: RunSettings, task: MarkingTask) -> tuple[str, object]:
    return "marked", 100


def other(how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    return _marked(task, student="someone else")


def crash(how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    raise ValueError("a worker's own mistake")


def failed(how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    return "failed", "OSError: No space left on device"


def fails_at_first(first: str, how: RunSettings, task: MarkingTask) -> tuple[str, str]:
    """Fails in the process that is asked first, which the file `first` names."""
    with open(first, "a+") as file:
        file.seek(0)
        asked = file.read() or str(os.getpid())
        file.truncate(0)
        file.write(asked)
    return failed(how, task) if asked == str(os.getpid()) else _marked(task)


def _marked(task: MarkingTask, **changes: str) -> tuple[str, str]:
    return "marked", replace(Result(task.student, task.assignment, task.key, "marked"), **changes).to_json()
