"""The graph on paper: four programs, and which of them publishes what to whom."""

from typing import NamedTuple

from grader.checks import Missed
from grader.exercise import Exercise
from grader.exercises.warehouse.blueprint.planned_nodes import ShelfCamera, publishes, sketch, subscribes
from grader.variants import Variants
from grader.worlds.warehouses import hall
from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, Recording

__all__ = ["ShelfCamera", "blueprint", "publishes", "sketch", "subscribes"]

POSE, POSES, TEXT = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseArray", "std_msgs/msg/String"
PROGRAMS = "perception", "reader", "decision", "control"
DRIVER = "/cmd_vel"

blueprint = Exercise("blueprint", "The graph on paper", world=hall, seconds=1, companions=[ShelfCamera],
                     variants=Variants(
    {"people": ("/people", "/pedestrians")},
    {"obstacles": ("/obstacles", "/boxes")},
    {"goal": ("/goal_pose", "/target_pose")},
    texts=("{people}", "{obstacles}", "{goal}"),
))


class PlannedTopic(NamedTuple):
    """Its type, which program publishes it ("" is the robot), and which programs must and may subscribe."""

    type: str
    publisher: str
    subscribers: tuple[str, ...]
    optional: tuple[str, ...] = ()


TOPICS = {
    "/scan": PlannedTopic("sensor_msgs/msg/LaserScan", "", ("perception",), ("control",)),
    "/image": PlannedTopic("sensor_msgs/msg/Image", "", ("reader",)),
    "/map": PlannedTopic("nav_msgs/msg/OccupancyGrid", "", ("perception", "control")),
    "/orders": PlannedTopic("warehouse_msgs/msg/Order", "", ("decision",)),
    "/battery_state": PlannedTopic("sensor_msgs/msg/BatteryState", "", ("decision",)),
    "/dock_pose": PlannedTopic(POSE, "", ("decision",)),
    "/label": PlannedTopic(TEXT, "reader", ("decision",)),
    "/robot_pose": PlannedTopic(POSE, "perception", ("control",), ("decision",)),  # the nearest order first
    "/people": PlannedTopic(POSES, "perception", ("control",)),
    "/obstacles": PlannedTopic(POSES, "perception", ("control",)),
    "/goal_pose": PlannedTopic(POSE, "decision", ("control",)),
    "/state": PlannedTopic(TEXT, "decision", ()),
    DRIVER: PlannedTopic("geometry_msgs/msg/Twist", "control", ()),
}


def _topics() -> dict[str, PlannedTopic]:
    """The topics of the plan, with the names of the variant that is judged."""
    drawn = blueprint.drawn
    names = {"/people": drawn.people, "/obstacles": drawn.obstacles, "/goal_pose": drawn.goal}
    return {names.get(name, name): topic for name, topic in TOPICS.items()}


@blueprint.check(2)
def has_four_programs(run: Recording) -> None:
    """There are four programs: perception, reader, decision and control."""
    there = sorted(name.strip("/") for name in run.graph.nodes if not run.is_course_node(name))
    if there != sorted(PROGRAMS):
        hint = "Each name in the plan is a program: one for each question, and no more."
        raise Missed(", ".join(sorted(PROGRAMS)), ", ".join(there) or "no program", hint)


@blueprint.check(3, after=has_four_programs)
def publishes_answers(run: Recording) -> None:
    """Each program publishes its results, with the right types."""
    hint = "Read each program's question: what does it publish, on which topic, of which type?"
    for name, topic in _topics().items():
        if topic.publisher:
            _require(run, "publisher", topic.publisher, name, topic.type, hint)


@blueprint.check(4, after=has_four_programs)
def subscribes_to_what_it_needs(run: Recording) -> None:
    """Each program subscribes to what its task needs, with the right types: control to /people, too."""
    for name, topic in _topics().items():
        for program in topic.subscribers:
            hint = "Read each program's question: what does it have to receive to answer it?"
            if topic.publisher == "perception":
                hint = "Safety must not depend on decision: control subscribes to perception directly."
            _require(run, "subscription", program, name, topic.type, hint)


@blueprint.check(3, after=subscribes_to_what_it_needs)
def subscribes_to_nothing_else(run: Recording) -> None:
    """No program subscribes to what it doesn't need: decision not to the lidar, control not to orders."""
    topics = _topics()
    for end in _endpoints(run, "subscription"):
        wanted, optional = topics[end.name][2:] if end.name in topics else ((), ())
        program = end.node.strip("/")
        if program not in (*wanted, *optional):
            who = ", ".join(wanted) or "none of the four"
            hint = "A program depends on what it subscribes to. One that receives everything is a god node."
            raise Missed(f"{end.name} received by {who}", f"{program} receives it, too", hint)


@blueprint.check(2, after=publishes_answers)
def has_one_publisher_for_each(run: Recording) -> None:
    """Each topic has one program that publishes it: only control commands the motors."""
    for end in _endpoints(run, "publisher"):
        program = end.node.strip("/")
        topic = _topics().get(end.name)
        if topic is None or topic.publisher != program:
            who = topic.publisher if topic and topic.publisher else "the robot" if topic else "no program"
            hint = "Give each topic one program that publishes it, and drop topics that no program needs."
            if end.name == DRIVER:
                hint = "Let exactly one program command the motors: the one that checks the gate first."
            raise Missed(f"{end.name} published by {who}", f"{program} publishes it", hint,
                         unsafe=end.name == DRIVER)


@blueprint.check(2, after=subscribes_to_what_it_needs)
def has_matching_qos(run: Recording) -> None:
    """Late joiners receive latched topics, and the QoS of sensor subscriptions matches the sensors'."""
    for end in _endpoints(run, "subscription"):
        program = end.node.strip("/")
        for other in [other.qos for other in run.graph.publishers(end.name) if other.from_course]:
            if other["durability"] == "transient_local" != end.qos["durability"]:
                hint = "The message was published before your program started: subscribe with LATCHED."
                saw = f"{program} receives only new messages"
                raise Missed(f"{end.name} received with LATCHED", saw, hint)
            if other["reliability"] == "best_effort" and end.qos["reliability"] == "reliable":
                saw = f"{program} requests reliable, and receives nothing"
                hint = "A sensor offers best effort, which doesn't match a subscription that requests more: "
                raise Missed(f"{end.name} received as best effort", saw, hint + "qos_profile_sensor_data.")


def _endpoints(run: Recording, kind: str) -> list[Endpoint]:
    """The student's endpoints on all topics that aren't ROS's own."""
    ends = run.graph.ends(kind)
    return [end for end in ends if not end.from_course and end.name not in INFRASTRUCTURE_TOPICS]


def _require(run: Recording, kind: str, program: str, name: str, type: str, hint: str) -> None:
    does = "publishes" if kind == "publisher" else "receives"
    found = [end for end in _endpoints(run, kind) if end.node.strip("/") == program]
    types = [end.type for end in found if end.name == name]
    if not types:
        names = ", ".join(sorted(end.name for end in found)) or "nothing"
        raise Missed(f"{program} {does} {name}", f"it {does} {names}", hint)
    if types[0] != type:
        raise Missed(f"{program} {does} {name} of type {type}", f"type {types[0]}", hint)
