"""What YAML makes of parameters' values: a word that it reads as true or false, a list of two types."""

from __future__ import annotations

import re
from pathlib import Path

from sim.evidence import CallbackError

_BOOLEAN = r"parameter '(.+)' to '(True|False)' of type 'BOOL', expecting type 'STRING'"
_MIXED = r"params file: '--params-file (\S+)'.* Value type '(\w+)' do not belong at line_num (\d+)"
_KEY = re.compile(r"^\s*([\w./]+)\s*:")


def yaml_boolean(error: CallbackError) -> str:
    """A text such as y, no or off, which ROS reads as true or false; "" for another error."""
    found = re.search(_BOOLEAN, error.text) if error.type == "InvalidParameterTypeException" else None
    if not found:
        return ""
    name, value = found[1], found[2].lower()
    words, quoted = ("y, yes, on", '"y"') if value == "true" else ("n, no, off", '"n"')
    return (
        f"The parameter `{name}` is text, but YAML reads {words} and {value} without quotes as {value}. "
        f"Quote it in a parameter file: {name}: {quoted}. A launch file's parameters={{...}} loses the "
        f"quotes: write ros_arguments=['-p', '{name}:={quoted}'] there."
    )


def mixed_list(error: CallbackError) -> str:
    """A list of two types in a file of parameters, by file, line and key; "" for another error."""
    found = re.search(_MIXED, error.text) if error.type == "RCLInvalidROSArgsError" else None
    if not found:
        return ""
    file, kind, line = found.groups()
    key = _key_at(Path(file), int(line))
    value = "a list" if not key else f"the list `{key}`"
    return (
        f"{file}, line {line}: {value} has a value of type {kind} after one of another type, but all values "
        "of a list must have the same type. `1` and `1.0` have different types, and text is a third."
    )


def _key_at(file: Path, line: int) -> str:
    """The last key of a YAML file down to this line; "" if it can't be read."""
    try:
        lines = file.read_text(encoding="utf-8").splitlines()[:line]
    except (OSError, UnicodeDecodeError):
        return ""
    return next((found[1] for each in reversed(lines) if (found := _KEY.match(each))), "")
