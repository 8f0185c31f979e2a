"""Pairs of an image and a scan of the same moment, at once and with bounded memory."""

from __future__ import annotations

import functools
from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.exercise import Exercise, Scenario
from grader.exercises.races.pairing.late_sensors import IMAGE, SCAN, SECONDS, late_sensors
from grader.responses import EDGE
from sim.evidence import Recording, Seconds, since_start

__all__ = ["late_sensors", "pairing"]

TOPIC, TYPE = "/pairs", "sensor_msgs/msg/TimeReference"
SAME, AT_ONCE = 0.03, 0.05  # s: between the stamps of a pair; until it is published
FRESH, OLD = 0.4, 1.5  # s: an age up to which a pair is due, and one from which there may be none
TOLERATED = 0.03  # the share of the pairs that may be missing

pairing = Exercise("pairing", "Pairs of one moment", scenarios=[
    Scenario(None, SECONDS, 1, functools.partial(late_sensors, IMAGE), name="camera"),
    Scenario(None, SECONDS, 2, functools.partial(late_sensors, SCAN), name="lidar"),
])  # fmt: skip

NO_PAIR = ("Stamps of two sensors are hardly ever equal: allow a difference of 0.03 s. And either message "
           "may be the second one, so both callbacks look for a pair.")  # fmt: skip
KEEPS_ALL = ("Your node still had a message from then, so it keeps all that find no partner: 36,000 scans "
             "in an hour without a camera. Forget what is older than a second.")  # fmt: skip


class Pair(NamedTuple):
    """An image and a scan, by their stamps, and a moment: when both are there, or when it was published."""

    image: Seconds
    scan: Seconds
    moment: Seconds

    @property
    def age(self) -> Seconds:
        """Return how old its older message is at that moment."""
        return self.moment - min(self.image, self.scan)


@pairing.check(1)
def publishes_pairs(run: Recording) -> list[Pair]:
    """On /pairs there are TimeReference messages, with the stamp of an image and that of a scan."""
    subscribes(run, IMAGE, "sensor_msgs/msg/Image")
    subscribes(run, SCAN, "sensor_msgs/msg/LaserScan")
    known = _stamps(run, IMAGE), _stamps(run, SCAN)
    pairs = []
    with hinting(NO_PAIR):
        rows = publishes(run, TOPIC, TYPE)
    for row in rows:
        pair = Pair(since_start(row.message.header.stamp), since_start(row.message.time_ref), row.stamp)
        for stamp, stamps, what in zip(pair, known, ("header.stamp", "time_ref"), strict=False):
            if round(stamp, 6) not in stamps:
                expected = f"the stamp of {'an image' if what == 'header.stamp' else 'a scan'} as {what}"
                hint = "header.stamp is the image's header.stamp, and time_ref the scan's; neither is now()."
                raise Missed(expected, f"{stamp:.6g} s in the pair of {row.stamp:.4g} s", hint)
        pairs.append(pair)
    return pairs


def _stamps(run: Recording, topic: str) -> dict[float, Seconds]:
    """When the messages of a topic arrived, by their stamps (s, rounded to 1 µs)."""
    return {round(since_start(row.message.header.stamp), 6): row.stamp for row in run.received(topic)}


@pairing.check(4, after=publishes_pairs, hints={
    "The right scan got lost, and no other is near enough. Then there is no pair.":
        lambda run, pair: not any(abs(stamp - pair.image) <= SAME for stamp in _stamps(run, SCAN)),
    "Newest with newest isn't the same moment: one of the two is on its way longer. Compare the stamps, and "
    "keep messages until their partner comes.": otherwise,
})
def pairs_one_moment(run: Recording, pairs: list[Pair]) -> list[Pair]:
    """The stamps of each pair are at most 0.03 s apart, and no image is in two pairs."""
    for pair in pairs:
        if not abs(pair.image - pair.scan) <= SAME + 1e-6:
            saw = f"{abs(pair.image - pair.scan):.3g} s apart, in the pair of {pair.moment:.4g} s"
            raise Missed(f"stamps at most {SAME:g} s apart", saw, about=(pair,))
    images = [round(pair.image, 6) for pair in pairs]
    if len(set(images)) < len(images):
        twice = next(stamp for number, stamp in enumerate(images) if stamp in images[:number])
        hint = "Forget the image and the scan of a pair when you publish it."
        raise Missed("one pair for an image", f"two for that of {twice:.4g} s", hint)
    return pairs


def _due(run: Recording) -> list[Pair]:
    """The pairs that could be made, each with the moment at which its second message arrived."""
    images, scans = _stamps(run, IMAGE), _stamps(run, SCAN)
    found = []
    for image, arrived in images.items():
        scan = min(scans, key=lambda stamp: abs(stamp - image))
        if abs(scan - image) <= SAME:
            found.append(Pair(image, scan, max(arrived, scans[scan])))
    return found


@pairing.check(3, after=pairs_one_moment, hints={
    "A message may be 0.25 s late, and several of the other topic come in that time: keep more than one.":
        lambda run, missing, due: len(missing) > 0.3 * len(due),
    "After messages were held up, the pairs of the last 0.4 s are due again: don't throw away everything.":
        otherwise,
})  # fmt: skip
def finds_the_pairs(run: Recording, pairs: list[Pair]) -> list[Pair]:
    """Of all pairs that could be made from messages of the last 0.4 s, at least 97 % are published."""
    due = [pair for pair in _due(run) if pair.age <= FRESH]
    made = {round(pair.image, 6) for pair in pairs}
    missing = [pair for pair in due if round(pair.image, 6) not in made]
    if len(missing) > TOLERATED * len(due):
        first = missing[0]
        expected = f"a pair of the image of {first.image:.4g} s and the scan of {first.scan:.4g} s"
        saw = f"{len(due) - len(missing)} of {len(due)} pairs"
        credit = max(0.0, 1 - 5 * len(missing) / len(due))
        raise Missed(expected, saw, about=(missing, due), credit=credit, measured=pairs)
    return pairs


@pairing.check(2, after=finds_the_pairs)
def pairs_at_once(run: Recording, pairs: list[Pair]) -> None:
    """Each pair is published within 0.05 s of the arrival of its second message."""
    both = {round(pair.image, 6): pair.moment for pair in _due(run)}
    for pair in pairs:
        late = pair.moment - both.get(round(pair.image, 6), pair.moment)
        if not late <= AT_ONCE + EDGE:
            hint = "Look for the partner in the callbacks of both topics, and not in a timer."
            saw = f"{late:.3g} s later, at {pair.moment:.4g} s"
            raise Missed(f"the pair of {pair.image:.4g} s within {AT_ONCE:g} s", saw, hint)


@pairing.check(2, after=finds_the_pairs)
def forgets(run: Recording, pairs: list[Pair]) -> None:
    """Messages without a partner are forgotten after a second: no pair is older than 1.5 s."""
    for pair in pairs:
        if not pair.age <= OLD:
            saw = f"one {pair.age:.3g} s old at {pair.moment:.4g} s"
            raise Missed(f"no pair older than {OLD:g} s", saw, KEEPS_ALL)
