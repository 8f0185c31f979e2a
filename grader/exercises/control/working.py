"""An exercise on callback groups: looking at pictures takes long, and a pole must not fall meanwhile."""

from __future__ import annotations

import itertools
import statistics

from grader.checks import Missed, hinting, keeps_deadline, publishes, stands, subscribes
from grader.checks.control import EFFORT
from grader.checks.silence import silence
from grader.exercise import Exercise
from grader.exercises.control.partners import Camera
from grader.exercises.control.places import work_cart
from sim.evidence import Recording

LIMIT = 0.035  # s
IN_TIME = "Push with each joint state, 100 times a second."
LOOKS, SOON = 0.3, 0.75  # s
FLOAT, PICTURE, PLACE = "std_msgs/msg/Float64", "std_msgs/msg/UInt8MultiArray", "std_msgs/msg/Int32"
ASIDE = (
    "A callback that takes long belongs in a callback group of its own, and a MultiThreadedExecutor spins "
    "the node: with one of the two alone nothing changes."
)

worker = Exercise("worker", "Out of the way", world=work_cart, seconds=10, companions=[Camera], seeds=(1, 2))


@worker.check(2)
def hears_and_speaks(run: Recording) -> None:
    """The node hears /picture, publishes efforts on /cart_effort and places on /brightest."""
    subscribes(run, "/picture", PICTURE)
    publishes(run, EFFORT, FLOAT, at_least=5)
    publishes(run, "/brightest", PLACE)


@worker.check(7, after=hears_and_speaks)
def keeps_it_up(run: Recording) -> None:
    """The pole stands for 10 s, while pictures come."""
    with hinting(ASIDE):
        stands(run)


@worker.check(5, after=keeps_it_up)
def keeps_the_deadline(run: Recording) -> None:
    """An effort comes at least every 0.035 s, also while a picture is looked at."""
    sent = [heard.stamp for heard in run.messages(EFFORT)]
    always = statistics.median(b - a for a, b in itertools.pairwise(sent)) > LIMIT
    keeps_deadline(run, EFFORT, LIMIT, hint=IN_TIME if always else ASIDE)


@worker.check(4, after=hears_and_speaks)
def looks_at_each_picture(run: Recording) -> None:
    """For each picture, the place of its brightest pixel is on /brightest: 0.3 s to 0.75 s later."""
    pictures = [heard for heard in run.messages("/picture") if heard.ours]
    due = [heard for heard in pictures if heard.stamp + SOON < run.ended.stamp]
    if not due:
        raise silence(run, "pictures", "none", run.graph.publishers("/picture"))
    answers = publishes(run, "/brightest", PLACE)
    for picture in due:
        pixels = list(picture.message.data)
        place = pixels.index(max(pixels))
        found = [one for one in answers if -1e-6 <= one.stamp - picture.stamp <= SOON]
        if not found or found[0].message.data != place or found[0].stamp < picture.stamp + LOOKS - 1e-6:
            when = f"{LOOKS:g} s to {SOON:g} s after the picture at {picture.stamp:.3g} s"
            raise Missed(
                f"{place} on /brightest, {when}",
                f"{found[0].message.data} at {found[0].stamp:.3g} s" if found else "nothing then",
                _why_no_answer(picture.stamp, [one.stamp for one in answers]),
            )
    if len(answers) > len(pictures):
        hint = "One message for each picture, when it has been looked at."
        raise Missed(f"{len(pictures)} messages on /brightest", f"{len(answers)}", hint)


def _why_no_answer(asked: float, answered: list[float]) -> str:
    if any(0 <= stamp - asked < LOOKS - 1e-6 for stamp in answered):
        return "Nobody can see so quickly: call look(...) for each picture, and publish what it returns."
    return "Call look(...) for each picture that comes, and publish what it returns. Leave none out."
