"""The nearest thing ahead, to the left and to the right, from any lidar's scans."""

import bisect
import itertools
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from grader.checks import Missed, hinting, lasts, otherwise, publishes, subscribes
from grader.companions.blind_drivers import Circling
from grader.exercise import Exercise, Scenario
from grader.exercises.sensing.sectors.scan_sectors import Sector, sector_of
from grader.exercises.sensing.sectors.strange_lidar import StrangeLidar
from grader.variants import Variants
from grader.worlds.rooms import furnished_room
from sim.evidence import Recording, Seconds, stamps

__all__ = ["StrangeLidar", "sectors"]

SCAN = "sensor_msgs/msg/LaserScan"
MIDDLES = {"/front": 0.0, "/left": 90.0, "/right": -90.0}  # degrees
EXPLAINED = 0.5  # of the points, where one mistake explains all distances
# Mistakes after which the rest can still be judged: which rays are taken then.
MISTAKES: list[Callable[..., Sector]] = [
    lambda scan, middle: sector_of(scan, -middle, _half()),
    lambda scan, middle: sector_of(scan, middle, 10.0),
    lambda scan, middle: sector_of(scan, middle, 60.0),
    lambda scan, middle: sector_of(scan, middle, _half(), wraps=False),
    lambda scan, middle: sector_of(scan, middle, _half(), converts=False),
]
LAG, PATIENCE = 0.02, 0.3  # seconds


class SectorValue(NamedTuple):
    """A node's message for a direction after a scan, None for nothing, and what there was to see."""

    stamp: Seconds
    topic: str
    value: float | None
    sector: Sector
    before: Sector | None  # of the scan before, where the node may not have received this one yet

    @property
    def right(self) -> bool:
        """Return whether it is what the rays show."""
        sectors = [sector for sector in (self.sector, self.before) if sector is not None]
        return self.value is not None and any(sector.fits(self.value) for sector in sectors)


sectors = Exercise("sectors", "Ahead, left and right", scenarios=[
    Scenario(world=furnished_room, seconds=6, seed=1, companions=[Circling]),
    Scenario(seconds=12, seed=2, companions=[StrangeLidar]),
], variants=Variants(
    {"half": (30, 20, 40)},  # degrees
    texts=("{half} degrees", "<= {half} and"),
))


@sectors.check(3)
def publishes_three_distances(run: Recording) -> list[SectorValue]:
    """The node subscribes to /scan, and publishes Float64 messages on /front, /left and /right."""
    subscribes(run, "/scan", SCAN)
    with hinting(guess="Create a publisher for each of the three, and publish on each after every scan."):
        for topic in MIDDLES:
            publishes(run, topic, "std_msgs/msg/Float64", at_least=5)
    return list(_answers(run))


def _all(condition: Callable[[SectorValue], bool]) -> Callable[..., bool]:
    """The cause of a miss: all wrong answers are like this."""
    return lambda run, wrong: all(map(condition, wrong))


def _returns_in_the_loop(run: Recording, wrong: list[SectorValue]) -> bool:
    first_ray = [answer.value == answer.sector.middle != math.inf for answer in wrong]
    return any(first_ray) and all(is_first or answer.value == math.inf
                                  for is_first, answer in zip(first_ray, wrong, strict=True))


def _sides(wrong: list[SectorValue]) -> list[SectorValue]:
    return [answer for answer in wrong if answer.topic != "/front"]


def _is_within(run: Recording, wrong: list[SectorValue]) -> bool:
    finite = [answer for answer in _sides(wrong) if answer.value and math.isfinite(answer.value)]
    return any(answer.value in answer.sector.rays for answer in finite)


def _is_too_far_aside(run: Recording, wrong: list[SectorValue]) -> bool:
    sides = _sides(wrong)
    return bool(sides) and all(answer.value in answer.sector.beside for answer in sides)


@sectors.check(5, after=publishes_three_distances, hints={
    "That is only one ray. Take the shortest of all rays up to 30 degrees to either side of it.":
        _all(lambda answer: answer.value == answer.sector.middle),
    "That is the first ray, or none at all: is your `return` after the loop, not inside it?":
        _returns_in_the_loop,
    "That is the greatest distance. min(...) finds the smallest one.":
        _all(lambda answer: answer.value is not None and answer.value >= answer.sector.rays.max()),
    "That is the nearest distance in any direction. Are both angles in degrees? math.degrees(...) "
    "converts radians to degrees.":
        lambda run, wrong: all(it.value == it.sector.around for it in wrong if it.topic == wrong[0].topic),
    "This lidar has 180 rays, and the first one points backwards. So don't count rays: compute each "
    "ray's angle, msg.angle_min + i * msg.angle_increment.": lambda run, wrong: run.world is None,
    "That covers only part of this direction: take the rays up to 30 degrees to either side.": _is_within,
    "That is too far to the side: use only the rays up to 30 degrees from the middle.": _is_too_far_aside,
    "This lidar's forward rays are at the two ends of its ranges: a ray at 350 degrees is the same as "
    "one at -10. Wrap the difference of two angles to -180 to 180: (angle - middle + 180) % 360 - 180.":
        lambda run, wrong: wrong[0].topic == "/front",
    "Angles are in radians, from straight ahead to the left: 90 degrees is left, -90 (or 270) is right.":
        otherwise,
})
def knows_the_directions(run: Recording, answers: list[SectorValue]) -> list[SectorValue]:
    """Each is the nearest distance in its direction, 30 degrees to either side, with any lidar."""
    try:
        _all_right(answers, "plain")
    except Missed as missed:
        for see in MISTAKES:
            answers = list(_answers(run, see))
            if all(answer.right for answer in answers if answer.sector.kind == "plain"):
                missed.credit, missed.measured = EXPLAINED, answers
        raise
    for topic in MIDDLES:
        lasts(run, topic)
    return answers


@sectors.check(4, after=knows_the_directions, hints={
    "Skip them before min(): `if not math.isnan(distance)`. Every comparison with nan is False.":
        otherwise
})
def leaves_out_lost_rays(run: Recording, answers: list[SectorValue]) -> None:
    """Lost rays (nan) change nothing."""
    _all_right(answers, "lost")


@sectors.check(3, after=knows_the_directions, hints={
    "max(0.0, distance) turns -inf into 0.0, and leaves everything else unchanged.":
        lambda run, wrong: wrong[0].sector.kind == "near",
    "If all rays are inf, the answer is inf. Skip only nan, and give min() a default for an empty list.":
        otherwise,
})
def knows_near_and_far(run: Recording, answers: list[SectorValue]) -> None:
    """If nothing is there, it is inf; something too close to be measured (-inf) is 0.0 m away."""
    _all_right(answers, "near")
    _all_right(answers, "empty")


def _all_right(answers: list[SectorValue], kind: str) -> None:
    """Raise Missed for a wrong answer about a sector of this kind."""
    wrong = [answer for answer in answers if answer.sector.kind == kind and not answer.right]
    if wrong:
        stamp, topic, value, sector, _ = wrong[0]
        expected = f"{sector.nearest:.3g} m on {topic} at {stamp:.3g} s{sector.text}"
        raise Missed(expected, "nothing" if value is None else f"{value:.3g} m", about=(wrong,))


def _half() -> float:
    return float(sectors.drawn.half)


def _answers(run: Recording, see: Callable[..., Sector] | None = None) -> Iterator[SectorValue]:
    """The last message on each topic after each scan and before the next one.

    see: which rays of a scan are in a direction.
    """
    see = see or (lambda scan, middle: sector_of(scan, middle, _half()))
    messages = {topic: run.messages(topic) for topic in MIDDLES}
    times = {topic: stamps(rows) for topic, rows in messages.items()}
    before: dict[str, Sector] = {}
    for scan, following in itertools.pairwise(run.messages("/scan")):
        seen = {topic: see(scan.message, middle) for topic, middle in MIDDLES.items()}
        for topic, sector in seen.items():
            if scan.stamp < 0.3:
                continue  # the node may just have started
            last = bisect.bisect_left(times[topic], following.stamp) - 1
            if last >= 0 and times[topic][last] >= scan.stamp:
                at_once = times[topic][last] < scan.stamp + LAG
                value = messages[topic][last].message.data
                yield SectorValue(scan.stamp, topic, value, sector, before.get(topic) if at_once else None)
            elif following.stamp > scan.stamp + PATIENCE:
                yield SectorValue(scan.stamp, topic, None, sector, None)
        before = seen
