"""Steps ir-sim: run by the Python of its own environment, task as JSON on stdin, result on stdout."""

import json
import sys
import tempfile
import time
from pathlib import Path

import irsim
import numpy as np
import yaml


def description(task: dict) -> dict:
    """The world in ir-sim's words."""
    lidar = {"type": "lidar2d", "range_min": 0, "range_max": task["reach"], "angle_range": 7, "noise": False}
    robot = {
        "kinematics": {"name": "diff"},
        "shape": {"name": "circle", "radius": task["radius"]},
        "state": [0, 0, 0],
        "vel_max": [1, 3],
        "sensors": [lidar | {"number": task["rays"]}],
    }
    walls = [
        {"shape": {"name": "linestring", "vertices": [[x0, y0], [x1, y1]]}, "state": [0, 0, 0]}
        for x0, y0, x1, y1 in task["segments"]
    ]
    discs = [
        {"shape": {"name": "circle", "radius": radius}, "state": [x, y, 0]} for x, y, radius in task["discs"]
    ]
    size = {"height": 40, "width": 40, "offset": [-20, -20]}
    return {
        "world": size | {"step_time": task["step"], "sample_time": task["step"]},
        "robot": [robot],
        "obstacle": walls + discs,
    }


def main() -> None:
    """Step for a while, then say how fast that was, and what was seen last from where."""
    task = json.load(sys.stdin)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "world.yaml"
        path.write_text(yaml.safe_dump(description(task)), encoding="utf-8")
        world = irsim.make(str(path), display=False, disable_all_plot=True, log_level="ERROR")
    command = np.array([[task["v"]], [task["w"]]])
    for _ in range(3):
        world.step(command)
    steps, begin = 0, time.perf_counter()
    while time.perf_counter() - begin < task["seconds"]:
        world.step(command)
        steps += 1
    rate = steps / (time.perf_counter() - begin)
    pose = world.robot.state[:3, 0].tolist()
    result = {"rate": rate, "pose": pose, "ranges": world.get_lidar_scan()["ranges"].tolist()}
    print(json.dumps(result))


if __name__ == "__main__":
    main()
