"""The definition and type description files that ROS installs for each message."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory

from sim.ros.messages.codec import message_class

IDL_NAMES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}


def definition(type_: str) -> str:
    """A message's definition followed by those it depends on, as MCAP's encoding "ros2msg" requires."""
    # The messages of a service or an action are described together with it.
    whole = re.sub(r"(/[^_/]+)_[^/]*$", r"\1", type_)
    description = json.loads(installed_file(whole, "json").read_text())["type_description_msg"]
    if whole == type_:
        dependencies = [other["type_name"] for other in description["referenced_type_descriptions"]]
    else:
        descriptions = {other["type_name"]: other for other in description["referenced_type_descriptions"]}
        dependencies = sorted(set(_dependencies(type_, descriptions)))
    return _text(type_) + "".join(
        f"\n{'=' * 80}\nMSG: {re.sub('/(msg|srv|action)/', '/', name)}\n{_text(name)}"
        for name in dependencies
    )


def _dependencies(type_: str, descriptions: dict[str, Any]) -> Iterator[str]:
    for field in descriptions[type_]["fields"]:
        nested = field["type"]["nested_type_name"]
        if nested:
            yield nested
            yield from _dependencies(nested, descriptions)


def _text(type_: str) -> str:
    """A message's own definition: the installed file or, if there is none, generated from the class."""
    if "_" not in type_.rpartition("/")[2]:
        return installed_file(type_, "msg").read_text()
    fields = message_class(type_).get_fields_and_field_types()
    return "".join(f"{_field_type(kind)} {name}\n" for name, kind in fields.items())


def _field_type(kind: str) -> str:
    """E.g. "float64[]" for "sequence<double>"."""
    sequence = re.fullmatch(r"sequence<(.+?)(?:, (\d+))?>", kind)
    if sequence is not None:
        return f"{_field_type(sequence[1])}[{f'<={sequence[2]}' if sequence[2] else ''}]"
    return re.sub(r"^\w+(?=\[|$)", lambda word: IDL_NAMES.get(word[0], word[0]), kind)


def installed_file(type_: str, suffix: str) -> Path:
    """The file that ROS installs for a type; it need not exist. Raises LookupError if its package doesn't.

    suffix: "msg", "srv" or "action" for the definition, "json" for the description.
    """
    package, path = type_.split("/", 1)
    return Path(get_package_share_directory(package)) / f"{path}.{suffix}"
