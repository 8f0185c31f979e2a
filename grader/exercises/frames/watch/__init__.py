"""Find two faults: a node waits for a robot that does not exist, and drives another one."""

import math

from grader.checks import Missed, publishes
from grader.companions.transforms import localization
from grader.exercise import Exercise, Scenario
from grader.exercises.frames.watch.tower_watcher import WAITING, Watcher
from grader.geometry.near import is_near
from grader.worlds.frame_worlds import square
from sim.evidence import Endpoint, Recording, Seconds

__all__ = ["Watcher", "watch"]

OUT, STRANGER = "/tower/cmd_vel", "/cmd_vel"
HALF = 0.2  # of the points, where one of the two faults is corrected: with the rest that makes half
SETTLED, BAND, STILL = 5.0, 0.3, 0.05  # s, rad, m
LATE, WAITS = 1.5, 2.0  # s: when localization publishes in one of the runs; the watcher's last fair warning


def _scenario(seed: int, late: Seconds = 0.0) -> Scenario:
    return Scenario(square, 9, seed, lambda seed: localization(square(seed), late))


watch = Exercise("watch", "The tower that does not watch", scenarios=[_scenario(1), _scenario(2, LATE)])


@watch.check(2)
def starts_the_watcher(run: Recording) -> None:
    """The watcher is started, under any name."""
    started = [row.node for row in run.parameters if row.declared and row.name == "target"]
    if not any(not run.is_course_node(node) for node in started):
        nodes = [name for name in run.graph.nodes if not run.is_course_node(name)]
        hint = "Start the class as it is: return Process(frames.Watcher, ...)."
        raise Missed("the watcher, with its parameter target", ", ".join(nodes) or "no node", hint)


@watch.check(10, after=starts_the_watcher)
def faces_the_scout(run: Recording) -> None:
    """From 5 s on the tower faces the scout, within 0.3 rad."""
    _require_no_waiting(run)
    _require_own_commands(run)
    publishes(run, OUT, "geometry_msgs/msg/Twist")
    for tower, scout in zip(run.tracks["tower"], run.tracks["scout"], strict=False):
        angle = math.atan2(scout.y - tower.y, scout.x - tower.x)
        off = abs(math.remainder(angle - tower.yaw, math.tau))
        if tower.stamp >= SETTLED and not off <= BAND:
            hint = "Which robot is it watching? Set `target` to the name of the one that drives: scout."
            raise Missed(f"at most {BAND:g} rad off the scout", f"{off:.2f} rad at {tower.stamp:.3g} s", hint)


@watch.check(4, after=faces_the_scout)
def leaves_others_alone(run: Recording) -> None:
    """The other robot stays where it is."""
    for pose in run.path:
        if not is_near(run.path[0][1:3], pose[1:3], STILL):
            hint = "That robot isn't yours: publish nothing on /cmd_vel."
            saw = f"it has moved by {pose.stamp:.3g} s"
            raise Missed("the other robot where it was", saw, hint, unsafe=True)


def _require_no_waiting(run: Recording) -> None:
    """Raise Missed where the watcher still waits for a frame."""
    warnings = [line for line in run.logs if not line.from_course and line.level == "WARN"]
    waits = [line for line in warnings if line.stamp > WAITS]
    if waits:
        is_watcher = all(line.text.startswith(WAITING) for line in waits)
        saw = f"“{waits[0].text}” at {waits[0].stamp:.3g} s"
        hint = "The log says which frame it is waiting for. Which robots are there? `target` is a parameter."
        credit = HALF if is_watcher and _publishers(run, OUT) else 0.0
        raise Missed(f"no warning after {WAITS:g} s", saw, hint, credit=credit)


def _require_own_commands(run: Recording) -> None:
    """Raise Missed where all commands go to another robot."""
    strange = _publishers(run, STRANGER)
    if strange and not _publishers(run, OUT):
        hint = ("Look at the graph: the watcher publishes on /cmd_vel, which belongs to another "
                "robot. Remap cmd_vel to the tower's own topic.")
        saw = f"{strange[0].node} publishes on {STRANGER}"
        raise Missed(f"commands on {OUT}", saw, hint, credit=HALF, unsafe=True)


def _publishers(run: Recording, topic: str) -> list[Endpoint]:
    return [end for end in run.graph.publishers(topic) if not end.from_course]
