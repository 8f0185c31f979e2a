"""An exercise on finding faults: a node that waits for a robot that isn't there, and drives another one."""

from __future__ import annotations

import math

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener

from grader.checks import Missed, hinting, named, publishes
from grader.exercise import Exercise
from grader.exercises.frames.partners import localization
from grader.exercises.frames.places import square
from sim.evidence import Recording

OUT, STRANGER = "/tower/cmd_vel", "/cmd_vel"
HALF = 0.2  # of the points, where one of the two faults is mended: with the rest that makes half
WAITING = "Waiting"  # what the watcher says of a frame that it doesn't know
SETTLED, BAND, STILL = 5.0, 0.3, 0.05  # s, rad, m or rad


class Watcher(Node):
    """Turns a tower so that it always faces another robot.

    Its parameter `target` is that robot's name. It publishes on cmd_vel, like all nodes that drive.
    """

    def __init__(self) -> None:
        super().__init__("watcher")
        self.declare_parameter("target", "turtle2")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.watch)

    def watch(self) -> None:
        """Turn towards the target."""
        target = f"{self.get_parameter('target').value}/base_link"
        try:
            found = self.buffer.lookup_transform("tower/base_link", target, Time())
        except TransformException as error:
            self.get_logger().warning(f"{WAITING}: {error}", throttle_duration_sec=1.0)
            return
        command, place = Twist(), found.transform.translation
        command.angular.z = max(-1.5, min(1.5, 2.0 * math.atan2(place.y, place.x)))
        self.publisher.publish(command)


watch = Exercise(
    "watch",
    "The tower that does not watch",
    world=square,
    seconds=9,
    companions=lambda seed: localization(square(seed)),
    seeds=(1, 2),
)


@watch.check(2)
def starts_the_watcher(run: Recording) -> None:
    """The watcher is started, as /watcher."""
    with hinting("launch hands back what is to be started: return Process(...), with frames.Watcher in it."):
        named(run, "/watcher")


@watch.check(10, after=starts_the_watcher)
def faces_the_scout(run: Recording) -> None:
    """From 5 s on the tower faces the scout, within 0.3 rad."""
    _waits_no_more(run)
    _drives_nobody_else(run)
    publishes(run, OUT, "geometry_msgs/msg/Twist")
    for tower, scout in zip(run.tracks["tower"], run.tracks["scout"], strict=False):
        angle = math.atan2(scout.y - tower.y, scout.x - tower.x)
        off = abs(math.remainder(angle - tower.yaw, math.tau))
        if tower.stamp >= SETTLED and not off <= BAND:
            hint = "Which robot does it look at? `target` is the name of the one that drives: scout."
            raise Missed(f"at most {BAND:g} rad off the scout", f"{off:.2f} rad at {tower.stamp:.3g} s", hint)


@watch.check(4, after=faces_the_scout)
def leaves_others_alone(run: Recording) -> None:
    """The other robot is left where it is."""
    begin = run.path[0]
    for pose in run.path:
        if math.dist((begin.x, begin.y), (pose.x, pose.y)) > STILL:
            hint = "That robot is not yours: send nothing on /cmd_vel."
            raise Missed(
                "the other robot where it was", f"it has moved by {pose.stamp:.3g} s", hint, unsafe=True
            )


def _waits_no_more(run: Recording) -> None:
    """Raises Missed where the watcher still waits for a frame."""
    waits = [line for line in run.logs if not line.from_course and line.level == "WARN" and line.stamp > 1.0]
    if waits:
        hint = "The log says which frame it waits for. Which robots are there? `target` is a parameter."
        watching = all(line.text.startswith(WAITING) for line in waits)  # it is our Watcher that warns
        mended = watching and [end for end in run.graph.publishers(OUT) if not end.from_course]
        told = f"“{waits[0].text}” at {waits[0].stamp:.3g} s"
        raise Missed("no warning after 1 s", told, hint, credit=HALF if mended else 0.0)


def _drives_nobody_else(run: Recording) -> None:
    """Raises Missed where all commands go to another robot."""
    strange = [end for end in run.graph.publishers(STRANGER) if not end.from_course]
    if strange and not [end for end in run.graph.publishers(OUT) if not end.from_course]:
        hint = (
            "Look at the graph: the watcher publishes on /cmd_vel, which is another robot's. A remapping, "
            "from cmd_vel to the tower's own topic, sends it there."
        )
        told = f"{strange[0].node} publishes on {STRANGER}"
        raise Missed(f"commands on {OUT}", told, hint, credit=HALF, unsafe=True)
