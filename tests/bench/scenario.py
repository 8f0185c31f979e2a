"""60 s with the robot in a room: the engine against rclpy's own SingleThreadedExecutor driven by /clock.

Both run the same robot node and the same student's node, with set-up and tear-down. The engine also runs
the whole main(), records every message and guards against hangs, which the other does not. The engine stops
at every moment at which any timer is due; /clock has a fixed rate, so the other is measured with two: the
slowest that serves these nodes, and that of the physics, which serves other periods to within 10 ms.
The engine runs once more with the student's node in another process, on the same core, as in marking.
"""

import atexit
import contextlib
import json
import os
import statistics
import sys
import time
from functools import cache, partial
from typing import Any

from grader.marking.sandbox.linux import same_addresses
from tests.bench.report import avoider_run, fresh, table
from tests.sim.ros.remote.follower_process import FollowerProcess

SECONDS, SECOND = 60, 1_000_000_000
ROUNDS, RUNS = 3, 3
Counts = dict[str, Any]


@cache
def _other_process() -> FollowerProcess:
    """Where the student's node lives: on one core with this one, as in marking."""
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    made = FollowerProcess()
    atexit.register(made.close)
    return made


def apart() -> Counts:
    """As `lockstep`, with the student's node in another process."""
    with _other_process().serving("tests.bench.avoider", "main") as remote:
        return lockstep(remote)


def lockstep(program: Any = None) -> Counts:
    """Through `sim.run`, as a student's cell does it. program: stands for one in another process."""
    recording = avoider_run(program, world="room", seconds=SECONDS)
    called = [(call.node, call.callback) for call in recording.callbacks]
    return {
        "clocks": len([received for received in recording.messages("/clock") if received.stamp > 0]),
        "scans": called.count(("/avoider", "Avoider.on_scan")),
        "odoms": called.count(("/avoider", "Avoider.on_odom")),
        "commands": len(recording.messages("/cmd_vel")),
        "pose": recording.path[-1][1:],
    }


def stock(rate: int) -> Counts:
    """On rclpy alone: after each /clock message, its executor spins until nothing is left to do."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rosgraph_msgs.msg import Clock

    from sim import World
    from sim.ros.robots.robot_node import Robot
    from sim.world import Simulation
    from tests.bench.avoider import Avoider

    world = World.load("room")
    rclpy.init(args=["--ros-args", "-p", "use_sim_time:=true"])
    simulation = Simulation(world)
    robot, student = Robot(world, simulation.robot), Avoider()
    publisher, robot.clock_pub = robot.clock_pub, _Silent()
    executor = SingleThreadedExecutor()
    executor.add_node(robot)
    executor.add_node(student)
    settle(executor)
    clock = Clock()
    for tick in range(1, SECONDS * rate + 1):
        clock.clock.sec, clock.clock.nanosec = divmod(tick * SECOND // rate, SECOND)
        simulation.advance(tick / rate)
        publisher.publish(clock)
        settle(executor)
    executor.shutdown()
    robot.destroy_node()
    student.destroy_node()
    rclpy.shutdown()
    return {
        "clocks": SECONDS * rate,
        "scans": student.scans,
        "odoms": student.odoms,
        "commands": student.commands,
        "pose": simulation.robot.pose,
    }


class _Silent:
    def publish(self, message: object) -> None:
        """The robot's own /clock would only say again what the bench has said."""


def settle(executor: Any) -> None:
    """Do what `spin_once` does until a wait finds nothing ready."""
    from rclpy.executors import TimeoutException

    worked = True
    while worked:  # the exception also comes after a wait that found work
        worked = False
        with contextlib.suppress(TimeoutException):
            while True:
                handler, _, _ = executor.wait_for_ready_callbacks(timeout_sec=0)
                worked = True
                handler()
                if handler.exception() is not None:
                    raise handler.exception()


VARIANTS = {
    "engine": lockstep,
    "engine, two processes": apart,
    "stock, /clock 20 Hz": partial(stock, 20),
    "stock, /clock 100 Hz": partial(stock, 100),
}


def measure_here(name: str) -> None:
    """Print the wall times of a few runs in this process, and what happened in them, as JSON."""
    import sim  # noqa: F401  (its import is a figure of its own)

    times = []
    for _ in range(RUNS):
        begin = time.perf_counter()
        counts = VARIANTS[name]()
        times.append(time.perf_counter() - begin)
    print(json.dumps({"times": times, "counts": counts}))


def main() -> None:
    """Compare. The variants take turns, so that what else the machine does hits all of them."""
    with same_addresses():  # as in marking
        rounds = [{name: fresh("tests.bench.scenario", name) for name in VARIANTS} for _ in range(ROUNDS)]
    times = {name: [t for found in rounds for t in found[name]["times"][1:]] for name in VARIANTS}
    usual = {name: statistics.median(times[name]) for name in VARIANTS}
    rows = []
    for name in VARIANTS:
        first = statistics.median(found[name]["times"][0] for found in rounds)
        *counts, pose = rounds[0][name]["counts"].values()
        figures = [f"{first:.2f}", f"{usual[name]:.2f}", f"{min(times[name]):.2f}"]
        ratios = [f"{SECONDS / usual[name]:.0f}", f"{min(times[name]) / min(times['engine']):.1f}"]
        rows.append([name, *figures, *ratios, *counts, " ".join(f"{value:.3f}" for value in pose)])
    print(f"{SECONDS} s of simulated time; {ROUNDS} processes with {RUNS} runs each. Wall time in s of first")
    print("runs (median) and of later ones (median, best); times real time (median); / engine (best).")
    header = ["", "first", "later", "best", "x real time", "/ engine"]
    table([*header, "/clock", "/scan", "/odom", "/cmd_vel", "ends at (m, m, rad)"], rows)


if __name__ == "__main__":
    measure_here(sys.argv[1]) if sys.argv[1:] else main()
