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
            self.get_logger().warning(f"Waiting: {error}", throttle_duration_sec=1.0)
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


@watch.check(1)
def starts_the_watcher(run: Recording) -> None:
    """The watcher is started, as /watcher."""
    with hinting("launch hands back what is to be started: return Process(...), with frames.Watcher in it."):
        named(run, "/watcher")


@watch.check(5, after=starts_the_watcher)
def finds_its_target(run: Recording) -> None:
    """It finds its target: it drives something, and waits no more."""
    waits = [line for line in run.logs if not line.ours and line.level == "WARN" and line.stamp > 1.0]
    sent = [one for topic in (OUT, STRANGER) for one in run.messages(topic) if not one.ours]
    if waits and not sent:
        hint = "The log says which frame it waits for. Which robots are there? `target` is a parameter."
        raise Missed("no warning after 1 s", f"“{waits[0].text}” at {waits[0].stamp:.3g} s", hint)
    if not sent:
        raise Missed("velocity commands", "none")


@watch.check(4, after=starts_the_watcher)
def leaves_others_alone(run: Recording) -> None:
    """The other robot, which listens to /cmd_vel, is left alone."""
    publishers = [end for end in run.graph.publishers(STRANGER) if not end.ours]
    if publishers:
        hint = (
            "Look at the graph: the watcher publishes on /cmd_vel, which is another robot's. A remapping, "
            "from cmd_vel to the tower's own topic, sends it there."
        )
        raise Missed(
            f"nobody of yours on {STRANGER}", f"{publishers[0].node} publishes there", hint, unsafe=True
        )
    begin, end = run.path[0], run.path[-1]
    if math.dist((begin.x, begin.y), (end.x, end.y)) > STILL:
        raise Missed("the other robot where it was", "it has been moved", unsafe=True)


@watch.check(6, after=(finds_its_target, leaves_others_alone))
def faces_the_scout(run: Recording) -> None:
    """From 5 s on the tower faces the scout, within 0.3 rad."""
    publishes(run, OUT, "geometry_msgs/msg/Twist")
    for tower, scout in zip(run.tracks["tower"], run.tracks["scout"], strict=False):
        angle = math.atan2(scout.y - tower.y, scout.x - tower.x)
        off = abs(math.remainder(angle - tower.yaw, math.tau))
        if tower.stamp >= SETTLED and not off <= BAND:
            hint = "Which robot does it look at? `target` is the name of the one that drives: scout."
            raise Missed(f"at most {BAND:g} rad off the scout", f"{off:.2f} rad at {tower.stamp:.3g} s", hint)
