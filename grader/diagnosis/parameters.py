"""Parameters that are set or requested, and that no node has, or has with another type."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from grader.diagnosis.ros_situations import empty_list_advice
from grader.diagnosis.student_nodes import node_classes
from sim.evidence import Call, Recording
from sim.notebook.class_source import methods_of
from sim.suggestions import closest_match, closest_ros_name

_GET, _SET = "/get_parameters", "/set_parameters"
_WHOLE = re.compile(r"Wrong parameter type, expected '\S*INTEGER' got '\S*DOUBLE'")
_EMPTY = re.compile(r"Wrong parameter type, expected '\S*BYTE_ARRAY' got '(?:\S*\.)?(\w+_ARRAY)'")
OF_EVERY_NODE = ("use_sim_time", "start_type_description_service", "qos_overrides.")


def unknown_parameter(recording: Recording) -> str:
    """A value for a parameter that no node of the student's declares: ROS drops it without a word.

    A lifecycle node may declare it in `on_configure`, and any other one in a callback that did not run.
    """
    rows = [
        row
        for row in recording.parameters
        if row.node not in recording.course_nodes and not row.name.startswith(OF_EVERY_NODE)
    ]
    declared = {row.name for row in rows if row.declared}
    for _, node, name, _ in rows:
        if name not in declared and not _may_be_declared(recording, node, name):
            own = dict.fromkeys(row.name for row in rows if row.declared and row.node == node)
            near = closest_match(name, own)
            listed = ", ".join(f"`{other}`" for other in own) or "none"
            meant = f"Did you mean `{near}`?" if near else f"It declares {listed}."
            return (
                f"{node} was started with a value for the parameter `{name}`, which it doesn't declare, and "
                f"ROS ignores it silently. {meant}"
            )
    return ""


def _may_be_declared(recording: Recording, node: str, name: str) -> bool:
    """Return whether code that did not run declares it, such as that of a lifecycle node never configured."""
    change = f"{node}/change_state"
    configured = any(call.service == change and call.response is not None for call in recording.calls)
    if not configured and any(end.name == change for end in recording.graph.ends("service")):
        return True
    return any(
        isinstance(part, ast.Call)
        and getattr(part.func, "attr", "").startswith("declare_parameter")
        and any(isinstance(leaf, ast.Constant) and leaf.value == name for leaf in ast.walk(part))
        for class_ in node_classes(recording)
        for method in methods_of(class_).values()
        for part in ast.walk(method)
    )


def misspelt_parameter(recording: Recording) -> str:
    """A parameter of the student's with nearly the name that a node of the course requests."""
    for call in _looked_up(recording, _GET, _SET):
        node, request = call.service.rpartition("/")[0], call.request
        names = request.names if call.service.endswith(_GET) else [one.name for one in request.parameters]
        declared = {row.name for row in recording.parameters if row.declared and row.node == node}
        own = [name for name in declared if not name.startswith(OF_EVERY_NODE)]
        for name in names:
            near = "" if name in declared else closest_ros_name(name, own)
            if near:
                return (
                    f"{call.client} requests the parameter `{name}` of {node}, which declares `{near}`: "
                    "spell it the same way everywhere."
                )
    return ""


def whole_parameter(recording: Recording) -> str:
    """A parameter of the student's that takes integers only, and is set to another number by the course."""
    for call in _looked_up(recording, _SET):
        for one, result in zip(call.request.parameters, call.response.results, strict=False):
            if _WHOLE.search(result.reason):
                node = call.service.removesuffix(_SET)
                return (
                    f"The parameter `{one.name}` of {node} takes only whole numbers, because its default is "
                    f"one, and ROS refuses {one.value.double_value:g}. Write the default with a decimal "
                    "point: 0.0, not 0."
                )
    return ""


def untyped_list(recording: Recording) -> str:
    """A parameter whose default is an empty list, and that is given a list of text or numbers."""
    for call in recording.calls:
        if not call.service.endswith(_SET) or call.response is None or call.served_by_course:
            continue
        for one, result in zip(call.request.parameters, call.response.results, strict=False):
            refused = _EMPTY.search(result.reason)
            if refused:
                return empty_list_advice(one.name, refused[1])
    return ""


def _looked_up(recording: Recording, *services: str) -> Iterator[Call]:
    """The answered calls of these services of the student's nodes by nodes of the course."""
    for call in recording.calls:
        answered = call.service.endswith(services) and call.response is not None
        if answered and call.requested_by_course and not call.served_by_course:
            yield call
