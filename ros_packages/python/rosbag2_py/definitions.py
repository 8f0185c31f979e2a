"""The definition of a message type with those that it depends on, as bags contain it."""

from __future__ import annotations

import re
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

BASIC = {
    *("bool", "byte", "char", "float32", "float64", "string", "wstring"),
    *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
}
RULE = "=" * 80


def message_definition(type_name: str) -> str:
    """The text for a type such as "std_msgs/msg/String"; "" if its package is not installed."""
    texts = {type_name: _text(type_name)}
    waiting = [type_name]
    while waiting:
        for other in _dependencies(waiting.pop(0), texts):
            if other not in texts:
                texts[other] = _text(other)
                waiting.append(other)
    first, *others = texts.items()
    return first[1] + "".join(
        f"\n{RULE}\nMSG: {name.replace('/msg/', '/')}\n{text}" for name, text in sorted(others)
    )


def _text(type_name: str) -> str:
    package, _, path = type_name.partition("/")
    try:
        return Path(get_package_share_directory(package), f"{path}.msg").read_text(encoding="utf-8")
    except (PackageNotFoundError, ValueError, OSError):
        return ""


def _dependencies(type_name: str, texts: dict[str, str]) -> list[str]:
    package = type_name.split("/")[0]
    found = []
    for line in texts[type_name].splitlines():
        word = re.match(r"\s*([A-Za-z][\w/]*)", line)
        if word and word[1] not in BASIC:
            parts = word[1].split("/")
            found.append(f"{parts[0] if len(parts) > 1 else package}/msg/{parts[-1]}")
    return found
