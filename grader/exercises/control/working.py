"""An exercise on callback groups: looking at pictures takes long, and a pole must not fall meanwhile."""

from __future__ import annotations

import itertools
import statistics
from typing import NamedTuple

from grader.checks import Missed, hinting, keeps_deadline, publishes, stands, subscribes
from grader.checks.control import EFFORT
from grader.checks.no_data import no_data
from grader.checks.topics import longest_pause
from grader.exercise import Exercise
from grader.exercises.control.partners import Camera
from grader.exercises.control.places import work_cart
from sim.evidence import Message, Recording, Seconds

LIMIT, ALONE = 0.035, 0.2  # s
IN_TIME = "Push with each joint state, 100 times a second."
LOOKS, SOON = 0.3, 0.75  # s
FLOAT, PICTURE, PLACE = "std_msgs/msg/Float64", "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/Int32"
ASIDE = (
    "A callback that takes long belongs in a callback group of its own, and a MultiThreadedExecutor spins "
    "the node: with one of the two alone nothing changes."
)

worker = Exercise("worker", "Out of the way", world=work_cart, seconds=10, companions=[Camera], seeds=(1, 2))


class Look(NamedTuple):
    """A picture of ours that had time for an answer, what is right, and what came in that time."""

    stamp: Seconds
    place: int
    answers: list[Message]

    @property
    def is_right(self) -> bool:
        """Whether the first of them is the place, and took its time."""
        first = self.answers[0] if self.answers else None
        return (
            first is not None
            and first.message.data == self.place
            and first.stamp >= self.stamp + LOOKS - 1e-6
        )


@worker.check(2)
def hears_and_speaks(run: Recording) -> None:
    """The node hears /picture, publishes efforts on /cart_effort and places on /brightest."""
    subscribes(run, "/picture", PICTURE)
    publishes(run, EFFORT, FLOAT, at_least=5)
    publishes(run, "/brightest", PLACE)


@worker.check(1, after=hears_and_speaks)
def looks_at_each_picture(run: Recording) -> None:
    """Each picture is looked at: the place of its brightest pixel is on /brightest 0.3 s to 0.75 s later."""
    looks = _looks(run)
    missed = [look for look in looks if not look.is_right]
    if missed:
        first = missed[0]
        told = [f"{one.message.data} at {one.stamp:.3g} s" for one in first.answers[:1]]
        when = f"{LOOKS:g} s to {SOON:g} s after the picture at {first.stamp:.3g} s"
        raise Missed(
            f"{first.place} on /brightest, {when}",
            told[0] if told else "nothing then",
            _why_no_answer(first.stamp, [one.stamp for one in run.messages("/brightest")]),
            credit=0.5 if 2 * len(missed) <= len(looks) else 0.0,
        )


@worker.check(8, after=looks_at_each_picture)
def keeps_it_up(run: Recording) -> None:
    """The pole is held up for 10 s, while pictures come."""
    with hinting(ASIDE):
        stands(run)
    pause, since = longest_pause([heard.stamp for heard in run.messages(EFFORT)])
    if pause > ALONE:
        saw = f"nobody pushing for {pause:.2g} s, from {since:.3g} s on: it stood by chance"
        raise Missed("a pole that is held up all the time", saw, ASIDE)


@worker.check(4, after=keeps_it_up)
def keeps_the_deadline(run: Recording) -> None:
    """An effort comes at least every 0.035 s, also while a picture is looked at."""
    sent = [heard.stamp for heard in run.messages(EFFORT)]
    always = statistics.median(b - a for a, b in itertools.pairwise(sent)) > LIMIT
    keeps_deadline(run, EFFORT, LIMIT, hint=IN_TIME if always else ASIDE)


@worker.check(3, after=keeps_it_up)
def answers_once(run: Recording) -> None:
    """One answer comes for each picture, and no other."""
    for look in _looks(run):
        told = [one.message.data for one in look.answers]
        if told != [look.place]:
            raise Missed(
                f"{look.place} on /brightest for the picture at {look.stamp:.3g} s, and nothing else",
                ", ".join(map(str, told)) or "nothing",
                "Publish what look(...) returns, once for each picture; leave none out.",
            )


def _looks(run: Recording) -> list[Look]:
    found, answers = [], run.messages("/brightest")
    for picture in run.messages("/picture"):
        begin, end = picture.stamp, picture.stamp + SOON
        if picture.from_course and end < run.ended.stamp:
            pixels = list(picture.message.data)
            said = [one for one in answers if begin - 1e-6 <= one.stamp <= end]
            found.append(Look(begin, pixels.index(max(pixels)), said))
    if not found:
        raise no_data(run, "pictures", "none", run.graph.publishers("/picture"))
    return found


def _why_no_answer(asked: float, answered: list[float]) -> str:
    if any(0 <= stamp - asked < LOOKS - 1e-6 for stamp in answered):
        return "Nobody can see so quickly: call look(...) for each picture, and publish what it returns."
    return "Call look(...) for each picture that comes, and publish what it returns. Leave none out."
