"""Reads launch files in XML into the same entities as those in YAML."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.parsers import expat

from launch.located import Located

# Elements that contain actions; in all others, elements are parts, listed by their name.
CONTAINERS = ("launch", "group", "timer", "ros_timer", "on_exit")
PARTS_OF_CONTAINERS = ("keep",)  # elements in a container that are no actions


class XmlText(str):
    """The text of an attribute, whose type is not known yet."""


class InvalidXml(ValueError):
    """A file is no XML; the message has its file and line."""


class _Element:
    def __init__(self, tag: str, content: Located) -> None:
        self.tag, self.content = tag, content

    def add(self, child: _Element) -> None:
        """Add an element: to the actions of a container, or to the parts of its name."""
        if self.tag in CONTAINERS and child.tag not in PARTS_OF_CONTAINERS:
            action = Located({child.tag: child.content})
            action.place = child.content.place
            self.content.setdefault("children", []).append(action)
        else:
            self.content.setdefault(child.tag, []).append(child.content)


def read_tree(path: str) -> dict[str, Any]:
    """The content of a file: {"launch": [actions]}. Raises InvalidXml."""
    root, stack = _Element("", Located()), []
    parser = expat.ParserCreate()

    def begin(tag: str, attributes: dict[str, str]) -> None:
        content = Located({name: XmlText(value) for name, value in attributes.items()})
        content.place = f"{path}, line {parser.CurrentLineNumber}"
        if tag in CONTAINERS and tag != "launch":
            content["children"] = []
        stack.append(_Element(tag, content))

    def end(tag: str) -> None:
        element = stack.pop()
        (stack[-1] if stack else root).add(element)

    def text(characters: str) -> None:
        if characters.strip() and stack:
            raise InvalidXml(
                f"<{stack[-1].tag}> contains the text {characters.strip()!r}: a value is an attribute "
                f"({path}, line {parser.CurrentLineNumber})"
            )

    parser.StartElementHandler, parser.EndElementHandler = begin, end
    parser.CharacterDataHandler = text
    try:
        parser.Parse(Path(path).read_bytes(), True)
    except expat.ExpatError as error:
        reason = expat.errors.messages[error.code]
        raise InvalidXml(f"{reason} ({path}, line {error.lineno}, column {error.offset + 1})") from None
    ((tag, (content, *_)),) = root.content.items()
    if tag != "launch":
        raise InvalidXml(f"{path} is not a launch file: its root has to be <launch>, but is <{tag}>.")
    return {"launch": content.get("children", [])}
