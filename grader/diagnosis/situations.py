"""Advice on an error that its words alone don't explain: what its node was doing is in the recording."""

from __future__ import annotations

import re

from grader.diagnosis.filter_situations import filter_callback, filter_input
from grader.diagnosis.joint_messages import absent_joint
from grader.diagnosis.other_types import other_type
from grader.diagnosis.package_rules import absent_launch_file, own_module
from grader.diagnosis.parameter_files import mixed_list, yaml_boolean
from grader.diagnosis.ray_angles import angles_of_arange
from grader.diagnosis.rays import rays_without_distance
from grader.diagnosis.ros_situations import (
    asyncio_pause,
    empty_list,
    init_in_with,
    invalid_description,
    invalid_transition,
    raising_transition,
)
from sim.evidence import CallbackError, Recording, last_line
from sim.ros.messages.codec import message_class

# An error's text, and how its line uses the attribute that is None; `{0}` is the operator in the text.
_USES_OF_NONE = {
    r"'NoneType' object is not subscriptable": r"\bself\.(\w+)\[(?!.*\]\[)",
    r"non-iterable NoneType|NoneType' object is not iterable|must be an iterable, not NoneType": (
        r"(?:\bin |\*|= |\()self\.(\w+)\b(?![(\[.])"
    ),
    r"for (\S+): 'NoneType' and|'(\S+)' not supported between instances of 'NoneType'": (
        r"\bself\.(\w+) *{0}(?![=*/<>])"
    ),
    r"for (\S+): '\w+' and 'NoneType'|'(\S+)' not supported between instances of '\w+' and 'NoneType'": (
        r"(?<![=*/<>]){0} *self\.(\w+)\b(?![(\[.])"
    ),
}
_SETS_PARAMETERS = "ParameterService._set_parameters_callback"


def advice_here(error: CallbackError, recording: Recording) -> str:
    """Return what to do about an error in its situation; "" where its words say enough."""
    return (
        own_module(error, recording)
        or error.note
        or _refusal(error, recording)
        or _too_early(error, recording)
        or _nothing_received(error, recording)
        or _no_future(error, recording)
        or _no_value(error)
        or _not_set_yet(error)
        or _called_with_too_little(error)
        or _gives_something_else(error)
        or _empty_slice(error)
        or other_type(error, recording)
        or _not_there(error)
        or _no_distance(error, recording)
        or angles_of_arange(error, recording)
        or absent_joint(error, recording)
        or filter_callback(error)
        or filter_input(error)
        or invalid_transition(error, recording)
        or raising_transition(error)
        or invalid_description(error, recording)
        or asyncio_pause(error)
        or init_in_with(error)
        or empty_list(error)
        or yaml_boolean(error)
        or mixed_list(error)
        or absent_launch_file(error)
    )


def _refusal(error: CallbackError, recording: Recording) -> str:
    """Something raised on purpose, to say no."""
    if not re.search(r"\n\s+raise \w.*\n[^\n]*\n?$", error.traceback):
        return ""
    if error.callback == _SETS_PARAMETERS:
        return (
            "An exception doesn't refuse anything; it ends the node. To refuse a value, "
            'return SetParametersResult(successful=False, reason="...").'
        )
    call = next((c for c in recording.calls if c.server == error.node and c.raised == error.type), None)
    if call is None:
        return ""
    no = "response.success = False, response.message = the reason, return response"
    how = no if call.type.endswith(("/Trigger", "/SetBool")) else "set its fields, and return the response"
    return (
        "An exception doesn't refuse anything: it ends the node, and the client waits for a response that "
        f"never arrives. Refuse in the response: {how}."
    )


def _too_early(error: CallbackError, recording: Recording) -> str:
    """Something taken out of a future that was still empty."""
    if not re.search(r"'NoneType' object (has no attribute|is not subscriptable)", error.text):
        return ""
    sent = [(c.client, c.requested, c.received, "call_async") for c in recording.calls]
    sent += [(goal.client, goal.requested, goal.answered, "send_goal_async") for goal in recording.goals]
    sent += [(goal.client, goal.answered, goal.received, "get_result_async") for goal in recording.goals]
    runs = [run for run in recording.callbacks if (run.node, run.callback) == (error.node, error.callback)]
    begin = max((run.stamp for run in runs if run.stamp <= error.stamp), default=0.0)
    for client, asked, received, what in sent:
        if client == error.node and received is None and asked is not None and asked >= begin:
            return (
                f"The response isn't there yet: {what} returns at once, with a future that is still empty. "
                "`future.add_done_callback(self.on_response)`, without parentheses after the method, lets "
                "ROS call it once the response has arrived; there, future.result() is the response."
            )
    return ""


def _nothing_received(error: CallbackError, recording: Recording) -> str:
    """A field of a message that has not come yet."""
    found = re.search(r"'NoneType' object has no attribute '(\w+)'", error.text)
    if found is None:
        return ""
    come = {received.topic for received in recording.published if received.stamp < error.stamp}
    for end in recording.graph.subscriptions():
        waits = end.node == error.node and end.name not in come
        if waits and found[1] in message_class(end.type).get_fields_and_field_types():
            return (
                f"No message has arrived on {end.name} by then, so the variable for the latest one is still "
                "None. Test for that first, with `is None`; before the first message, send zeros to a robot."
            )
    return ""


def _no_future(error: CallbackError, recording: Recording) -> str:
    """A done callback that doesn't take the future."""
    takes = r"(\w+)\(\) takes (?:1 positional argument but 2|0 positional arguments but 1)"
    found = re.search(takes, error.text)
    tasks = {(run.stamp, run.node, run.callback) for run in recording.callbacks if run.kind == "task"}
    if found is None or (error.stamp, error.node, error.callback) not in tasks:
        return ""
    name = found[1]
    return f"A done callback is called with the future: write `def {name}(self, future):`."


def _no_value(error: CallbackError) -> str:
    """A parameter used instead of the value it holds, or one that holds none."""
    line = last_line(error)
    empty = re.search(r"get_parameter\(['\"]([^)]*)['\"]\)\.value", line)
    if empty and "NoneType" in error.text:
        return (
            f"The parameter `{empty[1]}` has no value: it was declared without one, and none was given at "
            f"the start. Declare it with a default, declare_parameter('{empty[1]}', 1.0)."
        )
    if error.type in ("AssertionError", "KeyError") and re.search(r"get_parameter\([^)]*\)(?!\.)", line):
        return (
            "get_parameter() returns a parameter, which contains a value: write "
            "self.get_parameter('name').value."
        )
    return ""


def _not_set_yet(error: CallbackError) -> str:
    """An attribute that a callback sets, used before that."""
    cases = ((re.search(text, error.text), use) for text, use in _USES_OF_NONE.items())
    found, use = next(((found, use) for found, use in cases if found), (None, ""))
    if found is None or error.type != "TypeError":
        return ""
    operator = next(filter(None, found.groups()), "")
    names = set(re.findall(use.format(re.escape(operator)), last_line(error)))
    if len(names) != 1:
        return ""
    name = names.pop()
    return (
        f"`self.{name}` is None there. If a callback sets it, that callback may not have been called yet: "
        f"test first, with `if self.{name} is None:`."
    )


def _called_with_too_little(error: CallbackError) -> str:
    """A method that the student calls, and not ROS, without all that it needs."""
    known = "request|goal_handle|future"  # to the rules, as the methods create_... are
    found = re.search(rf"\b(?!create_)(\w+)\(\) missing \d+ .* arguments?: '(?!{known})", error.text)
    if found is None or f"self.{found[1]}(" not in last_line(error):
        return ""
    return (
        f"`{found[1]}` is called there without all of its arguments. Pass a callback without parentheses, "
        f"`self.{found[1]}`. And a star unpacks a pair: `self.{found[1]}(*pair)`."
    )


def _gives_something_else(error: CallbackError) -> str:
    """A method's value put into a field that takes another kind."""
    field = re.search(r"The '(\w+)' field must be of type '(float|int)'", error.text)
    called = re.search(r"=\s*self\.(\w+)\(", last_line(error))
    if field is None or called is None or called[1].startswith("get_"):
        return ""
    number = "a number with a decimal point, such as 1.0" if field[2] == "float" else "a whole number"
    return (
        f"`{field[1]}` takes {number}, but gets what `{called[1]}` returns: does every path through it end "
        "with `return` and one such number? `print` shows what it returns."
    )


def _empty_slice(error: CallbackError) -> str:
    """A slice that was to go from the end of a list over to its beginning."""
    part = re.search(r"\[(-\d+):(\d+)\]", last_line(error))
    if part is None or not re.search(r"(?:min|max)\(\) .*empty", error.text):
        return ""
    return (
        f"`[{part[1]}:{part[2]}]` is empty: a slice doesn't wrap around from the end of a list to its "
        f"beginning. Join two parts: `[*msg.ranges[{part[1]}:], *msg.ranges[:{part[2]}]]`."
    )


def _not_there(error: CallbackError) -> str:
    """A file or a program that is not found."""
    name = re.search(r"No such file or directory: '(.*?)'(?:\. (Did you mean '.*?'\?))?", error.text)
    if error.type != "FileNotFoundError" or name is None:
        return ""
    if re.search(r"subprocess|Popen|\brun\(|check_output\(|check_call\(", last_line(error)):
        return (
            f"There is no program `{name[1]}` on this machine. What it would do can often be done in Python: "
            "a node has methods for what `ros2 topic`, `ros2 service` and `ros2 param` do."
        )
    if name[2] or re.search(r"/share/.*\.launch(\.\w+)?$", name[1]):
        installed = "A launch file of a package has to be installed: its setup.py or CMakeLists.txt names it."
        return f"There is no file `{name[1]}`. {name[2] or installed}"
    return (
        f"There is no file `{name[1]}`. A name without a slash in front is looked for in the folder that the "
        "program was started in, here the notebook's: `os.getcwd()` names it, `os.listdir()` what is in it."
    )


def _no_distance(error: CallbackError, recording: Recording) -> str:
    """A ray's inf or nan that was calculated with as if it were a distance."""
    if not re.search(r"cannot convert float (?:infinity|NaN)|math domain error", error.text):
        return ""
    found = rays_without_distance(recording, error.node, error.stamp)
    return f"{found} Check `math.isfinite(distance)` before you calculate with it." if found else ""
