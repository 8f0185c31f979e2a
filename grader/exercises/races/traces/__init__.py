"""Which traces of a small node are possible under which executor."""

from collections.abc import Callable

from grader.checks import Missed, otherwise, publishes
from grader.exercise import Exercise
from grader.exercises.races.traces.interleavings import EXCLUSIVE, EXECUTORS, REENTRANT, SINGLE
from grader.exercises.races.traces.listed import TRACES, possible_traces
from grader.exercises.races.traces.senders import senders
from sim.evidence import Recording

__all__ = ["TRACES", "senders", "traces"]

TOPIC, TYPE = "/possible", "std_msgs/msg/String"
FORM = "one message for each executor: its name, a colon, and the numbers, such as “single: 3 7”"

traces = Exercise("traces", "Possible or not?", seconds=1)


def _too_many(*numbers: int) -> Callable[..., bool]:
    """The cause of a miss: one of these traces is called possible, and isn't."""
    return lambda run, executor, found: bool(set(numbers) & (found - possible_traces(executor)))


def _too_few(*numbers: int) -> Callable[..., bool]:
    """The cause of a miss: one of these traces is possible, and isn't called so."""
    return lambda run, executor, found: bool(set(numbers) & (possible_traces(executor) - found))


FROM_NOWHERE = {
    "A callback can read a 1 only after another has written it. Each callback publishes “reads” before it "
    "writes, so which lines must come before the first 1?": _too_many(7),
}


@traces.check(2, hints=FROM_NOWHERE | {
    "The lines of two callbacks are mixed. A single thread runs each callback to its end before it begins "
    "the next one; only an `await` would change that.": _too_many(4, 5, 6, 8),
    "One publisher's messages arrive at a subscription in the order in which they were published.":
        _too_many(3),
    "Which of several topics is served first isn't fixed, even in one thread.": otherwise,
})  # fmt: skip
def knows_a_single_thread(run: Recording) -> None:
    """Exactly the right traces are called possible under the SingleThreadedExecutor."""
    _judge(run, SINGLE)


@traces.check(3, hints=FROM_NOWHERE | {
    "`on_parcel` is in a mutually exclusive group: its next call, for whichever topic, begins when the "
    "previous one has ended.": _too_many(5, 6),
    "A's and B's messages wait in one queue, and a mutually exclusive group takes the second when the first "
    "is done.": _too_many(3),
    "Two groups, two threads: the report can come between any two statements of a parcel.": _too_few(4),
    "Between reading the total and publishing it, another thread may do a lot: a line says what was read, "
    "not what is true when the line appears.": _too_few(8),
    "Whatever a single thread can do, several threads can do, too.": otherwise,
})  # fmt: skip
def knows_exclusive_groups(run: Recording) -> None:
    """Exactly the right ones are called possible with several threads and two mutually exclusive groups."""
    _judge(run, EXCLUSIVE)


@traces.check(3, hints=FROM_NOWHERE | {
    "The GIL keeps one bytecode instruction at a time from being disturbed. Reading, adding and writing are "
    "several statements, and the thread can change between any two of them.": _too_few(5),
    "Two calls of one callback run side by side in a reentrant group: the second one can overtake the "
    "first.": _too_few(3),
    "A line is published after its statement, and the thread can change in between: C can read 0 long before "
    "“C reads 0” appears.": _too_few(6, 8),
    "Whatever exclusive groups permit, a reentrant group permits, too.": otherwise,
})  # fmt: skip
def knows_a_reentrant_group(run: Recording) -> None:
    """Exactly the right ones are called possible with several threads and one reentrant group."""
    _judge(run, REENTRANT)


def _judge(run: Recording, executor: str) -> None:
    """Raise Missed unless the last message about an executor has exactly the possible traces."""
    found = _answer(run, executor)
    wrong = found ^ possible_traces(executor)
    if wrong:
        expected = f"{executor}: every trace that is possible, and no other"
        saw = f"{_text(found)}: {len(wrong)} of {len(TRACES)} wrong"
        raise Missed(expected, saw, about=(executor, found))


def _text(numbers: set[int]) -> str:
    return ", ".join(map(str, sorted(numbers))) or "none"


def _answer(run: Recording, executor: str) -> set[int]:
    """The traces that are called possible under an executor. Raises Missed without such an answer."""
    texts = [row.message.data for row in publishes(run, TOPIC, TYPE)]
    about = [text for text in texts if text.partition(":")[0].strip() == executor]
    if not about:
        names = ", ".join(EXECUTORS)
        saw = ", ".join(dict.fromkeys(f"“{text}”" for text in texts))
        raise Missed(f"a message about “{executor}” on {TOPIC}", f"only {saw}", f"The names are {names}.")
    words = about[-1].partition(":")[2].replace(",", " ").split()
    if not all(word in map(str, TRACES) for word in words):
        hint = f"Publish {FORM}."
        raise Missed(f"numbers from 1 to {len(TRACES)} after “{executor}:”", f"“{about[-1]}”", hint)
    return set(map(int, words))
