"""A physics step and a 360-ray scan, side by side with ir-sim in the same worlds.

ir-sim is no requirement of the course. It is installed, when this is asked for, into an environment of its
own in a folder that git ignores.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from sim.world import DT, Circle, LidarModel, Simulation, World
from sim.world.lidar import Lidar
from tests.bench.report import table
from tests.bench.world import clutter

PEER = "ir-sim==2.12.0"
FOLDER = Path(__file__).parents[2] / ".venv-peers"
SIZES = ((20, 0), (50, 10), (200, 50))  # segments, discs
REACH, SECONDS, V, W = 10.0, 3.0, 0.1, 0.5


def peer_python() -> str | None:
    """The Python that has ir-sim; None, after saying why, where it cannot be installed."""
    python = FOLDER / "bin" / "python"
    if python.exists() and not subprocess.run([python, "-c", "import irsim"], capture_output=True).returncode:
        return str(python)
    for command in ([sys.executable, "-m", "venv", FOLDER], [python, "-m", "pip", "install", "-q", PEER]):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            reason = (done.stderr or done.stdout).strip().splitlines()[-1:]
            print(f"{PEER} could not be installed, so there is nothing to compare with: {' '.join(reason)}")
            return None
    return str(python)


def own(segments: np.ndarray, discs: np.ndarray, lidar: LidarModel) -> float:
    """Steps with a scan in a second."""
    world = World(
        "clutter",
        "",
        (-20, -20, 20, 20),
        walls=tuple(((x0, y0), (x1, y1)) for x0, y0, x1, y1 in segments),
        circles=tuple(Circle(*disc) for disc in discs),
        lidar=lidar,
    )
    simulation = Simulation(world)
    steps, begin = 0, time.perf_counter()
    while time.perf_counter() - begin < SECONDS:
        simulation.robot.command(V, W)
        simulation.advance((steps + 1) * DT)
        simulation.robot.scan()
        steps += 1
    return steps / (time.perf_counter() - begin)


def other(python: str, segments: np.ndarray, discs: np.ndarray, lidar: LidarModel) -> dict[str, Any]:
    """The same by ir-sim."""
    task = {
        "segments": segments.tolist(),
        "discs": discs.tolist(),
        "rays": lidar.rays,
        "reach": lidar.range_max,
        "radius": World.load("yard").robot.radius,
        "step": DT,
        "seconds": SECONDS,
        "v": V,
        "w": W,
    }
    done = subprocess.run(
        [python, Path(__file__).with_name("irsim_peer.py")],
        input=json.dumps(task),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        check=True,
        env=os.environ | {"MPLBACKEND": "Agg"},
    )
    return json.loads(done.stdout.splitlines()[-1])


def disagreement(seen: dict[str, Any], segments: np.ndarray, discs: np.ndarray, lidar: LidarModel) -> float:
    """The share of rays in which the two lidars differ by more than a millimeter, from the peer's last pose.

    The peer's first and last ray look backwards, both in the same direction. Its discs are polygons.
    """
    x, y, yaw = seen["pose"]
    eye = Lidar(LidarModel(rays=lidar.rays - 1, range_max=REACH), segments, discs)
    expected = np.minimum(eye.distances(x, y, yaw - np.pi), REACH)
    return float(np.mean(np.abs(expected - seen["ranges"][:-1]) > 1e-3))


def main() -> None:
    """Print a row for each size of world."""
    python = peer_python()
    if python is None:
        return
    lidar, rows = LidarModel(range_min=0, range_max=REACH, noise=0), []
    for size in SIZES:
        segments, discs = clutter(*size)
        seen, rate = other(python, segments, discs, lidar), own(segments, discs, lidar)
        apart = disagreement(seen, segments, discs, lidar)
        rates = f"{rate:.0f}", f"{seen['rate']:.0f}", f"{rate / seen['rate']:.0f}"
        rows.append([f"{size[0]} + {size[1]}", *rates, f"{apart:.1%}"])
    print(f"Steps of {DT * 1e3:g} ms with a scan of {lidar.rays} rays and {REACH:g} m, in a second")
    table(["segments + discs", "own", PEER, "ratio", "rays that differ"], rows)


if __name__ == "__main__":
    main()
