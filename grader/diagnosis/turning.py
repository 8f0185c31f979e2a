"""A turn by an angle that is never done: the robot turns on, past every heading that it could stop at."""

from __future__ import annotations

import ast
import contextlib
import itertools
import math

from grader.diagnosis.driving import VelocityCommand, of_robots
from grader.diagnosis.student_nodes import StudentNode, student_nodes
from sim.evidence import Recording
from sim.notebook.attribute_analysis import aliases, guards, own_attribute, reached, reads, writes

_HEADINGS = ("nav_msgs/msg/Odometry", "sensor_msgs/msg/Imu")
_TURNS = 2.0  # full ones, on which each heading was passed more than once
_NUMBERS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)


def endless_turn(recording: Recording) -> str:
    """A node that compares its heading with something, and turns the robot on the spot until the end."""
    commands = dict(of_robots(recording)).get("/cmd_vel", [])
    turning = [*itertools.takewhile(_turns, reversed(commands))]
    if not turning:
        return ""
    begin, sender = turning[-1].stamp, turning[0].sender
    yaws = [pose.yaw for pose in recording.path if pose.stamp >= begin]
    turns = abs(sum(math.remainder(b - a, math.tau) for a, b in itertools.pairwise(yaws))) / math.tau
    if turns < _TURNS or not any(
        node.name == sender and _stops_by_heading(node) for node in student_nodes(recording)
    ):
        return ""
    return (
        f"{sender} has turned the robot on the spot since {begin:.3g} s, by {turns:.2g} full turns, and "
        "never found the turn done. Compare the normalized difference with a tolerance, "
        "`abs(math.remainder(target - yaw, math.tau)) < 0.05`, because a heading, in radians, jumps from pi "
        "to -pi; and calculate the target once, before the turn."
    )


def _turns(command: VelocityCommand) -> bool:
    return abs(command.v) < 0.01 and command.w != 0.0


def _stops_by_heading(node: StudentNode) -> bool:
    """Return whether what it does depends on the heading in odometry, and on nothing else that arrives."""
    odometry = [callback for callback in node.registered if _kind(node, callback) in _HEADINGS]
    parts = {callback: node.parts(callback) for callback in node.registered}
    of_odometry = [method for callback in odometry for method in parts[callback]]
    heading = set(writes(of_odometry)) - {""}
    inputs = [name for name, row in node.registered.items() if row.kind != "timer" and name not in odometry]
    others = {name for callback in inputs for name in writes(parts[callback])}
    tested = set(guards(node.methods.values(), node.methods))
    if not odometry or tested & others or any(_adds_up(node, name) for name in heading):
        return False
    return any(
        method in of_odometry or heading & _read(node, method, part)
        for method in node.methods.values()
        for part in _comparisons(method)
    )


def _kind(node: StudentNode, callback: str) -> str:
    end = node.subscription(callback)
    return end.type if end is not None else ""


def _comparisons(method: ast.AST) -> list[ast.Compare]:
    """The comparisons of numbers in a method, without those that only decide what is logged or counted."""
    idle = {
        id(part)
        for statement in ast.walk(method)
        if isinstance(statement, ast.If) and not any(map(_acts, ast.walk(statement)))
        for part in ast.walk(statement.test)
    }
    found = [part for part in ast.walk(method) if isinstance(part, ast.Compare) and id(part) not in idle]
    return [
        part for part in found if any(isinstance(each, _NUMBERS) for each in part.ops) and not _is_met(part)
    ]


def _is_met(part: ast.Compare) -> bool:
    """Return whether it compares a heading with a number, so that a full turn makes it true only once."""
    sides = [part.left, *part.comparators]
    numbers = [side for side in sides if not isinstance(side, ast.Name) and not own_attribute(side)]
    with contextlib.suppress(ValueError):
        return all(abs(ast.literal_eval(number)) < math.pi for number in numbers) and len(numbers) == 1
    return False


def _acts(part: ast.AST) -> bool:
    return isinstance(part, ast.Assign | ast.Return | ast.Break | ast.Continue) or "publish" in (
        getattr(part, "attr", "")
    )


def _read(node: StudentNode, method: ast.AST, part: ast.AST) -> set[str]:
    """The attributes that an expression reads: itself, by local names, or in methods that it calls."""
    known = aliases(method)
    names = set(reads([part]))
    names |= {
        name for leaf in ast.walk(part) if isinstance(leaf, ast.Name) for name in known.get(leaf.id, ())
    }
    return names | {
        inner for name in names & node.methods.keys() for inner in reads(reached(name, node.methods))
    }


def _adds_up(node: StudentNode, name: str) -> bool:
    """Return whether an attribute is a sum, such as the angle since the start, over any number of turns."""
    for method in node.methods.values():
        for part in ast.walk(method):
            if isinstance(part, ast.AugAssign) and ast.unparse(part.target) == f"self.{name}":
                return True
            if isinstance(part, ast.Assign) and name in set(writes(part.targets)) & _read(
                node, method, part.value
            ):
                return True
    return False
