"""The simulated world without ROS: lidar against pymunk's own ray queries, and physics."""

import math
import random
import time
from collections.abc import Callable

import numpy as np
import pymunk

from sim.world import DT, LidarModel, Simulation, World
from sim.world.lidar import Lidar
from tests.bench.report import table
from tests.sim.world.mobile import MOBILE

SEGMENTS, DISCS, POSES, REACH = 50, 10, 200, 30.0
PHYSICS_SECONDS = 60


def clutter(straight: int = SEGMENTS, round_: int = DISCS) -> tuple[np.ndarray, np.ndarray]:
    """Segments (n, 4) and discs (n, 3) around the origin, none within 1.5 m of it; m."""
    chance = random.Random(1)
    segments, discs = [], []
    for index in range(straight + round_):
        far, bearing, turn = chance.uniform(2, 8), chance.uniform(0, math.tau), chance.uniform(0, math.tau)
        x, y = far * math.cos(bearing), far * math.sin(bearing)
        if index < straight:
            segments.append((x, y, x + 0.4 * math.cos(turn), y + 0.4 * math.sin(turn)))
        else:
            discs.append((x, y, 0.3))
    return np.array(segments).reshape(-1, 4), np.array(discs).reshape(-1, 3)


def pymunk_scanner(segments: np.ndarray, discs: np.ndarray, rays: int) -> Callable[..., list[float]]:
    """A lidar of one `segment_query_first` for each ray."""
    space, everything = pymunk.Space(), pymunk.ShapeFilter()
    for x0, y0, x1, y1 in segments:
        space.add(pymunk.Segment(space.static_body, (x0, y0), (x1, y1), 0))
    for x, y, radius in discs:
        space.add(pymunk.Circle(space.static_body, radius, (x, y)))

    def scan(x: float, y: float, yaw: float) -> list[float]:
        ranges = []
        for ray in range(rays):
            angle = yaw + ray * math.tau / rays
            end = x + REACH * math.cos(angle), y + REACH * math.sin(angle)
            hit = space.segment_query_first((x, y), end, 0, everything)
            ranges.append(hit.alpha * REACH if hit else math.inf)
        return ranges

    return scan


def lidar() -> None:
    """Compare the two on the same poses, in time and in what they measure."""
    segments, discs = clutter()
    chance = random.Random(2)
    poses = [
        (chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(0, math.tau)) for _ in range(POSES)
    ]
    model = LidarModel()
    scanners = {
        "own": Lidar(model, segments, discs).distances,
        "pymunk segment_query_first": pymunk_scanner(segments, discs, model.rays),
    }
    times, scans = {}, {}
    for name, scan in scanners.items():
        begin = time.perf_counter()
        scans[name] = np.array([scan(*pose) for pose in poses])
        times[name] = (time.perf_counter() - begin) / POSES
    own, other = scans.values()
    met = np.isfinite(own)
    assert (met == np.isfinite(other)).all(), "the two lidars disagree on which rays meet something"
    print(f"A scan of {model.rays} rays, {SEGMENTS} segments and {DISCS} discs, without noise")
    fastest = min(times.values())
    rows = [
        [name, f"{seconds * 1e6:.0f}", f"{1 / seconds:.0f}", f"{seconds / fastest:.1f}"]
        for name, seconds in times.items()
    ]
    table(["", "us/scan", "scans/s", "ratio"], rows)
    print(f"greatest difference in a distance: {np.abs(own[met] - other[met]).max():.0e} m")


def physics() -> None:
    """Drive a robot about in every world."""
    rows = []
    for name in MOBILE:
        simulation = Simulation(World.load(name), seed=1)
        steps = round(PHYSICS_SECONDS / DT)
        begin = time.perf_counter()
        for step in range(1, steps + 1):
            if step % 10 == 1:
                simulation.robot.command(0.4, 0.8 * math.sin(step * DT))
            simulation.advance(step * DT)
        seconds = time.perf_counter() - begin
        rows.append([name, f"{steps / seconds:.0f}", f"{PHYSICS_SECONDS / seconds:.0f}"])
    print(f"Physics in steps of {DT * 1e3:g} ms")
    table(["", "steps/s", "x real time"], rows)


def main() -> None:
    """Both."""
    lidar()
    print()
    physics()


if __name__ == "__main__":
    main()
