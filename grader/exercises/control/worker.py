"""Callback groups: processing a picture takes long, and a pole must not fall meanwhile."""

import itertools
import statistics

from grader.checks import Missed, hinting, keeps_deadline, otherwise, publishes, stands, subscribes
from grader.checks.control import EFFORT
from grader.checks.topics import longest_pause
from grader.companions.control_streams import Camera
from grader.exercise import Exercise
from grader.responses import EDGE, Stimuli, Stimulus
from grader.variants import Variants
from grader.worlds.carts import work_cart
from sim.evidence import Message, Recording

LIMIT, ALONE = 0.035, 0.2  # s
LOOKS, SOON = 0.3, 0.75  # s
ASIDE = ("A slow callback needs its own callback group, and the node needs a MultiThreadedExecutor: either "
         "one alone changes nothing.")

worker = Exercise("worker", "Out of the way", world=work_cart, seconds=10, companions=[Camera], seeds=(1, 2),
                  waits=False, variants=Variants(
    {"topic": ("/brightest", "/light", "/brightest_pixel")}, texts=("{topic}",),
))


@worker.check(2)
def subscribes_and_publishes(run: Recording) -> None:
    """The node subscribes to /picture, and publishes efforts on /cart_effort and positions on /brightest."""
    subscribes(run, "/picture", "std_msgs/msg/UInt8MultiArray")
    publishes(run, EFFORT, "std_msgs/msg/Float64", at_least=5)
    publishes(run, worker.drawn.topic, "std_msgs/msg/Int32")


@worker.check(1, after=subscribes_and_publishes, hints={
    "Nothing can process a picture so quickly: call look(...) for each picture, and publish what it returns.":
        lambda run, picture: any(_is_early(picture, row) for row in picture.responses),
    "Call look(...) for each picture that arrives, and publish what it returns. Leave none out.": otherwise,
})
def looks_at_each_picture(run: Recording) -> None:
    """Each picture is processed: its brightest pixel's position is on /brightest 0.3 s to 0.75 s later."""
    taken = _pictures(run)
    missed = []
    for picture in taken:
        if picture.values()[:1] != [_brightest(picture)] or _is_early(picture, picture.responses[0]):
            missed.append(picture)
    if missed:
        first = missed[0]
        saw = [f"{row.message.data} at {row.stamp:.3g} s" for row in first.responses] or ["nothing then"]
        when = f"{LOOKS:g} s to {SOON:g} s after the picture at {first.stamp:.3g} s"
        credit = 0.5 if 2 * len(missed) <= len(taken) else 0.0
        expected = f"{_brightest(first)} on {worker.drawn.topic}, {when}"
        raise Missed(expected, saw[0], about=(first,), credit=credit)


@worker.check(8, after=looks_at_each_picture)
def keeps_it_up(run: Recording) -> None:
    """The pole is held up for 10 s, while pictures come."""
    with hinting(ASIDE):
        stands(run)
    pause, since = longest_pause([row.stamp for row in run.messages(EFFORT)])
    if pause > ALONE:
        saw = f"no push for {pause:.2g} s, from {since:.3g} s on: it stood by chance"
        raise Missed("a pole that is held up all the time", saw, ASIDE)


@worker.check(4, after=keeps_it_up)
def keeps_the_deadline(run: Recording) -> None:
    """An effort comes at least every 0.035 s, even while a picture is processed."""
    sent = [row.stamp for row in run.messages(EFFORT)]
    always = statistics.median(b - a for a, b in itertools.pairwise(sent)) > LIMIT
    hint = "Publish an effort for each joint state, 100 times a second." if always else ASIDE
    keeps_deadline(run, EFFORT, LIMIT, hint=hint)


@worker.check(3, after=keeps_it_up)
def answers_once(run: Recording) -> None:
    """There is exactly one answer for each picture, and no other."""
    for picture in _pictures(run):
        if picture.values() != [_brightest(picture)]:
            topic = worker.drawn.topic
            expected = f"{_brightest(picture)} on {topic} for the picture at {picture.stamp:.3g} s"
            hint = "Publish what look(...) returns, once for each picture; leave none out."
            raise Missed(f"{expected}, and nothing else", picture.seen(), hint)


def _pictures(run: Recording) -> list[Stimulus]:
    answers = worker.drawn.topic
    return Stimuli("/picture", answered_on=answers, within=SOON, what="pictures")(run)


def _brightest(picture: Stimulus) -> int:
    """The place of the brightest pixel."""
    pixels = list(picture.value.data)
    return pixels.index(max(pixels))


def _is_early(picture: Stimulus, answer: Message) -> bool:
    """Return whether an answer comes before the picture can have been looked at."""
    return answer.stamp < picture.stamp + LOOKS - EDGE
