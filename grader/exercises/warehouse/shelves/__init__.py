"""A node that waits for a database with asyncio, and does its other work meanwhile."""

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.ends import declared
from grader.checks.topics import longest_pause
from grader.checks.work import worked_until
from grader.exercise import Exercise
from grader.exercises.warehouse.shelves.parcel_database import LABELS, scanner, seconds_for, stored
from grader.exercises.warehouse.shelves.parcel_library import shelf_of
from grader.responses import EDGE, from_course, from_student, text_of
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds

__all__ = ["scanner", "shelf_of", "shelves"]

ALIVE, SHELVES = "/alive", "/shelf"
MOST = 4.4  # s: as long as the slowest three answers take, one after the other
SLACK, PAUSE = 0.3, 0.25  # s: an answer after the database's; between two messages on /alive
STRING = "std_msgs/msg/String"
TOO_SELDOM = ("spin_once() runs one callback each time. Sleep 0.02 s between two calls, with "
              "await asyncio.sleep(0.02).")

shelves = Exercise("shelves", "asyncio alongside rclpy", seconds=15, companions=scanner, seeds=(1, 2),
                   variants=Variants(
    {"between": (": ", " -> ", " = ")},  # a label and its shelf
    texts=("P481{between}C7", "{{label}}{between}{{shelf}}", "label{between}shelf"),
))


@shelves.check(1, guess="Leave __init__ unchanged, and let rclpy.spin_once run what is due.")
def has_its_endpoints(run: Recording) -> None:
    """The node subscribes to /label, and publishes on /alive and on /shelf."""
    subscribes(run, LABELS, STRING)
    publishes(run, ALIVE, "std_msgs/msg/Empty")
    declared(run, "publisher", SHELVES, STRING, f"a publisher of type {STRING} on {SHELVES}")


@shelves.check(3, after=has_its_endpoints, hints={
    "That is the coroutine itself: without `await` it doesn't start. Write await warehouse.shelf_of(label).":
        lambda run, label, texts: any("coroutine" in text for text in texts),
    "A shelf was published with another parcel's label. Several coroutines run at the same time, so "
    "each needs its own label: pass it as an argument.":
        lambda run, label, texts: any(text.endswith(_answer(run, "", label)) for text in texts),
    "A task runs only while asyncio's event loop gets a turn. Write `await asyncio.sleep(0.02)` after each "
    "spin_once(): rclpy.spin() and time.sleep() never give it one.":
        lambda run, label, texts: not from_student(run, SHELVES),
    "Each label gets one answer, the database's: start a task for each, and cancel none.": otherwise,
})
def answers_each_label(run: Recording) -> list[tuple[Message, Message]]:
    """For each label, the database's answer is published once on /shelf, as “label: shelf”."""
    answers, found = from_student(run, SHELVES), []
    for row in from_course(run, LABELS, settled=MOST, what="labels"):
        label = row.message.data
        wanted, ready = _answer(run, label, label), row.stamp + seconds_for(run.seed, label)
        later = [answer for answer in answers if answer.stamp >= row.stamp - EDGE]
        begin = f"{label}{shelves.drawn.between}".rstrip()
        own = [answer for answer in later if answer.message.data.startswith(begin)]
        if [answer.message.data for answer in own] != [wanted] or own[0].stamp < ready - EDGE:
            expected = f"one “{wanted}”, at {ready:.3g} s or later"
            texts = [answer.message.data.partition(" at 0x")[0] for answer in later]
            shown = [answer.message.data.partition(" at 0x")[0] for answer in own] or texts[:3]
            seen = ", ".join(map(text_of, shown)) or "nothing"
            raise Missed(expected, f"{seen} after the label at {row.stamp:.3g} s", about=(label, texts))
        found.append((row, own[0]))
    return found


@shelves.check(2, after=answers_each_label, hints={
    TOO_SELDOM: lambda run, label: _longest_callback(run) < PAUSE < _longest_silence(run)[0],
    "Start a task for each label in the callback, and return at once: then the database searches for all of "
    "them at the same time.": otherwise,
})
def answers_side_by_side(run: Recording, found: list[tuple[Message, Message]]) -> None:
    """A label doesn't wait until the database has found the earlier ones."""
    for label, answer in found:
        ready = label.stamp + seconds_for(run.seed, label.message.data)
        if answer.stamp > ready + SLACK:
            expected = f"“{answer.message.data}” by {ready + SLACK:.3g} s, found at {ready:.3g} s"
            raise Missed(expected, f"it at {answer.stamp:.3g} s", about=(label,), picture="topics")


@shelves.check(1, after=answers_each_label)
def leaves_the_processor(run: Recording) -> None:
    """While nothing is due, the program sleeps: others on this computer need the processor, too."""
    if run.busy_loops:
        loop = run.busy_loops[0]
        hint = ("asyncio.sleep(0), or no pause at all, keeps a whole processor core busy: sleep 0.02 s, with "
                "await asyncio.sleep(0.02).")
        raise Missed("a pause between two calls of spin_once()", f"none from {loop.stamp:.3g} s on", hint)


@shelves.check(1, after=answers_each_label, hints={
    "A callback waited for {seconds:.2g} s, and so did the whole node. Start a task there, and return at "
    "once.":
        lambda run, pause: _longest_callback(run) > PAUSE and {"seconds": _longest_callback(run)},
    TOO_SELDOM: otherwise,
})
def stays_alive(run: Recording) -> None:
    """Messages come on /alive all the time, even while the database searches: at most 0.25 s apart."""
    pause, since = _longest_silence(run)
    if pause > PAUSE:
        saw = f"none for {pause:.2g} s, from {since:.3g} s on"
        raise Missed(f"a message on {ALIVE} every 0.1 s", saw, about=(pause,), picture="topics")


def _answer(run: Recording, shown: str, label: str) -> str:
    """The text with which a label's shelf is published. shown: the label in it."""
    return f"{shown}{shelves.drawn.between}{stored(run.seed, label)}"


def _longest_silence(run: Recording) -> tuple[Seconds, Seconds]:
    """The longest time without a message on /alive, and its begin."""
    stamps = [row.stamp for row in from_student(run, ALIVE)]
    return longest_pause([run.started_at, *stamps, worked_until(run)])


def _longest_callback(run: Recording) -> Seconds:
    return max((row.duration for row in run.callbacks if row.node not in run.course_nodes), default=0.0)
