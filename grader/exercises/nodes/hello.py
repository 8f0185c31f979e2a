"""A node that says hello."""

from grader.checks import Missed, hinting, logs
from grader.exercise import Exercise
from sim.evidence import Recording

hello = Exercise("hello", "A node that says hello", seconds=3, may_end=True)
HELLO = r"^\W*?Hello, robot!"


@hello.check(7)
def logs_hello(run: Recording) -> None:
    """The node logs “Hello, robot!” at info level."""
    silent = "Debug lines are hidden, so use info. If you do, is your method ever called?"
    with hinting("" if run.logs or run.prints else silent):
        logs(run, HELLO, level="INFO", example="Hello, robot!")


@hello.check(3, after=logs_hello)
def logs_it_once(run: Recording) -> None:
    """It does so once."""
    count = len(logs(run, HELLO))
    if count > 1:
        raise Missed("one line", f"{count} lines", "__init__ runs once for each node: log the line there.")
