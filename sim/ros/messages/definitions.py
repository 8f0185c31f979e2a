"""What ROS installs with each message: its definition, and the description that was made of it."""

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
    """A message's definition followed by those it needs, as MCAP's registry asks for encoding "ros2msg"."""
    whole = re.sub(r"(/[^_/]+)_[^/]*$", r"\1", type_)  # a part of an action or service is described with it
    described = json.loads(installed(whole, "json").read_text())["type_description_msg"]
    if whole == type_:
        needed = [other["type_name"] for other in described["referenced_type_descriptions"]]
    else:
        descriptions = {other["type_name"]: other for other in described["referenced_type_descriptions"]}
        needed = sorted(set(_needed(type_, descriptions)))
    return _text(type_) + "".join(
        f"\n{'=' * 80}\nMSG: {re.sub('/(msg|srv|action)/', '/', name)}\n{_text(name)}" for name in needed
    )


def _needed(type_: str, descriptions: dict[str, Any]) -> Iterator[str]:
    for field in descriptions[type_]["fields"]:
        nested = field["type"]["nested_type_name"]
        if nested:
            yield nested
            yield from _needed(nested, descriptions)


def _text(type_: str) -> str:
    """A message's own definition: as it was installed, or written from its class where no file has it."""
    if "_" not in type_.rpartition("/")[2]:
        return installed(type_, "msg").read_text()
    fields = message_class(type_).get_fields_and_field_types()
    return "".join(f"{_field_type(kind)} {name}\n" for name, kind in fields.items())


def _field_type(kind: str) -> str:
    """E.g. "float64[]" for "sequence<double>"."""
    sequence = re.fullmatch(r"sequence<(.+?)(?:, (\d+))?>", kind)
    if sequence is not None:
        return f"{_field_type(sequence[1])}[{f'<={sequence[2]}' if sequence[2] else ''}]"
    return re.sub(r"^\w+(?=\[|$)", lambda word: IDL_NAMES.get(word[0], word[0]), kind)


def installed(type_: str, suffix: str) -> Path:
    """A file that ROS installs for a type: "msg", "srv" or "action" defines it, "json" describes it.

    Raises LookupError for a package that there is none of. The file need not be there.
    """
    package, path = type_.split("/", 1)
    return Path(get_package_share_directory(package)) / f"{path}.{suffix}"
