"""An exercise on the graph on paper: four programs, and who tells whom what."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from grader.checks import Missed
from grader.exercise import Exercise
from grader.exercises.delivery.plan import Camera, hall
from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, Recording

POSE, POSES, TEXT = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseArray", "std_msgs/msg/String"
PROGRAMS = "perception", "reader", "decision", "control"
DRIVER = "/cmd_vel"

blueprint = Exercise("blueprint", "The graph on paper", world=hall, seconds=1, companions=[Camera])


class Topic(NamedTuple):
    """Its type, which of the programs publishes it ("" is the robot), and which hear it."""

    type: str
    said_by: str
    heard_by: tuple[str, ...]


TOPICS = {
    "/scan": Topic("sensor_msgs/msg/LaserScan", "", ("perception",)),
    "/image": Topic("sensor_msgs/msg/Image", "", ("reader",)),
    "/map": Topic("nav_msgs/msg/OccupancyGrid", "", ("perception", "control")),
    "/orders": Topic("warehouse_msgs/msg/Order", "", ("decision",)),
    "/battery_state": Topic("sensor_msgs/msg/BatteryState", "", ("decision",)),
    "/dock_pose": Topic(POSE, "", ("decision",)),
    "/label": Topic(TEXT, "reader", ("decision",)),
    "/robot_pose": Topic(POSE, "perception", ("control",)),
    "/people": Topic(POSES, "perception", ("control",)),
    "/obstacles": Topic(POSES, "perception", ("control",)),
    "/goal_pose": Topic(POSE, "decision", ("control",)),
    "/state": Topic(TEXT, "decision", ()),
    DRIVER: Topic("geometry_msgs/msg/Twist", "control", ()),
}


@blueprint.check(2)
def has_four_programs(run: Recording) -> None:
    """There are four programs: perception, reader, decision and control."""
    there = sorted(name.strip("/") for name in run.graph.nodes if not run.is_course_node(name))
    if there != sorted(PROGRAMS):
        hint = "Each name in the plan is a program; one for each question, and no more."
        raise Missed(", ".join(sorted(PROGRAMS)), ", ".join(there) or "no program", hint)


@blueprint.check(3, after=has_four_programs)
def each_says_its_answer(run: Recording) -> None:
    """Each program publishes its answers, with the right types."""
    hint = "Read the question of each program: what does it say, on which topic, of which type?"
    for name, topic in TOPICS.items():
        if topic.said_by:
            _must_have(run, "publisher", topic.said_by, name, topic.type, hint)


@blueprint.check(4, after=has_four_programs)
def each_hears_what_it_needs(run: Recording) -> None:
    """Each program hears what its question needs, with the right types: control hears of people itself."""
    for name, topic in TOPICS.items():
        for program in topic.heard_by:
            hint = "Read the question of each program: of what does it have to hear to answer?"
            if name in ("/people", "/obstacles", "/robot_pose"):
                hint = "Safety must not depend on decision: control hears perception directly."
            _must_have(run, "subscription", program, name, topic.type, hint)


@blueprint.check(3, after=each_hears_what_it_needs)
def nobody_hears_more(run: Recording) -> None:
    """Nobody hears what isn't needed: who decides hears no lidar, and who drives no orders."""
    for end in _ends(run, "subscription"):
        wanted = TOPICS[end.name].heard_by if end.name in TOPICS else ()
        program = end.node.strip("/")
        if program not in wanted:
            who = ", ".join(wanted) or "none of the four"
            hint = "What a program hears, it depends on. Whoever hears everything is a god node."
            raise Missed(f"{end.name} heard by {who}", f"{program} hears it, too", hint)


@blueprint.check(2, after=each_says_its_answer)
def one_says_each(run: Recording) -> None:
    """Each topic has one program that publishes it: control alone commands the motors."""
    for end in _ends(run, "publisher"):
        program = end.node.strip("/")
        topic = TOPICS.get(end.name)
        if topic is None or topic.said_by != program:
            who = topic.said_by if topic and topic.said_by else "the robot" if topic else "nobody"
            hint = "One topic, one program that publishes there, and no topic that nobody asked for."
            if end.name == DRIVER:
                hint = "Exactly one program commands the motors: the one that asks the gate before."
            raise Missed(f"{end.name} published by {who}", f"{program} publishes it", hint)


@blueprint.check(2, after=each_hears_what_it_needs)
def settings_fit(run: Recording) -> None:
    """What is latched is heard by who comes late, and the sensors are heard as they speak."""
    for end in _ends(run, "subscription"):
        for other in run.graph.publishers(end.name):
            kept, best = (
                other.qos["durability"] == "transient_local",
                other.qos["reliability"] == "best_effort",
            )
            if other.from_course and kept and end.qos["durability"] != "transient_local":
                hint = "The message was published before your program began: hear it with KEPT."
                raise Missed(
                    f"{end.name} heard with KEPT", f"{end.node.strip('/')} hears what is new only", hint
                )
            if other.from_course and best and end.qos["reliability"] == "reliable":
                hint = (
                    "A sensor is best effort, and isn't heard by who asks for more: qos_profile_sensor_data."
                )
                saw = f"{end.node.strip('/')} asks for reliable, and hears nothing"
                raise Missed(f"{end.name} heard as best effort", saw, hint)


def _ends(run: Recording, kind: str) -> Iterator[Endpoint]:
    """The student's ends on topics of the plan, or on others that aren't ROS's own."""
    return (
        end for end in run.graph.ends(kind) if not end.from_course and end.name not in INFRASTRUCTURE_TOPICS
    )


def _must_have(run: Recording, kind: str, program: str, name: str, type: str, hint: str) -> None:
    does = "publishes" if kind == "publisher" else "hears"
    mine = [end for end in _ends(run, kind) if end.node.strip("/") == program]
    found = next((end for end in mine if end.name == name), None)
    if found is None:
        names = ", ".join(sorted(end.name for end in mine)) or "nothing"
        raise Missed(f"{program} {does} {name}", f"it {does} {names}", hint)
    if found.type != type:
        raise Missed(f"{program} {does} {name} of type {type}", f"type {found.type}", hint)
