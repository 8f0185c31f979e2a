"""Lookups in tf2_ros' buffer against a naive list: all received ones, searched from the beginning."""

import itertools
import math
import random
import time
from collections.abc import Callable

import numpy as np
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_ros import Buffer

from tests.bench.report import table

CHAIN = ("map", "odom", "base_link", "arm", "camera")  # each the child of the one before
SECONDS, LOOKUPS = 10.0, 200
Pose = tuple[float, float, float]  # x, y (m), yaw (rad)


def received(rate: float) -> list[TransformStamped]:
    """What moving frames say in 10 s, in the order in which it comes."""
    said = []
    for tick in range(1, round(SECONDS * rate) + 1):
        stamp = tick / rate
        for number, (parent, child) in enumerate(itertools.pairwise(CHAIN)):
            one = TransformStamped(child_frame_id=child)
            one.header.frame_id, one.header.stamp = parent, Time(nanoseconds=round(stamp * 1e9)).to_msg()
            move, yaw = one.transform, 0.3 * stamp + number
            move.translation.x, move.translation.y = math.cos(stamp + number), math.sin(stamp)
            move.rotation.z, move.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
            said.append(one)
    return said


def naive(said: list[TransformStamped]) -> Callable[[Time], Pose]:
    """The camera in the map, as one writes it at first: by a loop over the list for each step of the way."""

    def step(child: str, stamp: float) -> np.ndarray:
        before = after = None
        for one in said:
            if one.child_frame_id == child:
                at = one.header.stamp.sec + one.header.stamp.nanosec / 1e9
                before = (at, one) if at <= stamp else before
                after = (at, one) if at >= stamp and after is None else after
        (begin, first), (end, last) = before, after
        part = (stamp - begin) / (end - begin) if end > begin else 0.0
        x, y, yaw = (a + part * (b - a) for a, b in zip(flat(first), flat(last), strict=True))
        cos, sin = math.cos(yaw), math.sin(yaw)
        return np.array([[cos, -sin, x], [sin, cos, y], [0.0, 0.0, 1.0]])

    def lookup(when: Time) -> Pose:
        found = np.eye(3)
        for child in CHAIN[1:]:
            found = found @ step(child, when.nanoseconds / 1e9)
        return found[0, 2], found[1, 2], math.atan2(found[1, 0], found[0, 0])

    return lookup


def buffered(said: list[TransformStamped]) -> Callable[[Time], Pose]:
    """The same by tf2_ros."""
    buffer = Buffer()
    for one in said:
        buffer.set_transform(one, "bench")
    return lambda when: flat(buffer.lookup_transform(CHAIN[0], CHAIN[-1], when))


def flat(one: TransformStamped) -> Pose:
    """x, y and yaw of a transform."""
    move = one.transform
    yaw = 2 * math.atan2(move.rotation.z, move.rotation.w)
    return move.translation.x, move.translation.y, yaw


def main() -> None:
    """Ask both for the same moments, and compare what they say."""
    rows = []
    for rate in (20, 100):
        said, chance = received(rate), random.Random(1)
        moments = [Time(seconds=chance.uniform(0.5, SECONDS - 0.5)) for _ in range(LOOKUPS)]
        seconds, answers = {}, {}
        for name, make in (("naive list", naive), ("tf2_ros", buffered)):
            lookup = make(said)
            begin = time.process_time()
            answers[name] = [lookup(when) for when in moments]
            seconds[name] = (time.process_time() - begin) / LOOKUPS
        for one, other in zip(*answers.values(), strict=True):
            turned = math.remainder(one[2] - other[2], math.tau)
            assert math.dist(one[:2], other[:2]) < 1e-6 and abs(turned) < 1e-6, "the two disagree"
        slowest = max(seconds.values())
        rows += [
            [f"{name}, {rate} Hz", f"{each * 1e6:.0f}", f"{1 / each:.0f}", f"{slowest / each:.1f}"]
            for name, each in seconds.items()
        ]
    print(f"{len(CHAIN) - 1} moving frames in a chain, {SECONDS:g} s of each remembered; at random times")
    table(["", "us/lookup", "lookups/s", "ratio"], rows)


if __name__ == "__main__":
    main()
