"""A pool that has all results ready, for tests of what is done with them."""
import contextlib
from collections.abc import Callable, Iterable, Iterator

from grader.marking.command.mark_class import OpenPool, Settings
from grader.marking.gradebook.course import Course
from grader.marking.result import Result
from grader.marking.task import MarkingTask
from tests.marking.classroom import result

Change = Callable[[Course, MarkingTask], Result]


class ReadyPool:
    """Gives each task its result at once. marked: who was asked for."""

    def __init__(self, course: Course, change: Change = result) -> None:
        self.course, self.change = course, change
        self.marked: list[str] = []
        self.settings: list[Settings] = []
        self.secret = ""

    def open(self, settings: Settings, secret: str) -> contextlib.AbstractContextManager["ReadyPool"]:
        self.settings.append(settings)
        self.secret = secret
        return contextlib.nullcontext(self)

    def mark(self, tasks: Iterable[MarkingTask]) -> Iterator[Result]:
        for task in tasks:
            self.marked.append(task.student)
            yield self.change(self.course, task)

    def again(self) -> list[str]:
        """Who was asked for since the last call."""
        marked, self.marked = self.marked, []
        return marked


def opening(course: Course) -> OpenPool:
    return ReadyPool(course).open
