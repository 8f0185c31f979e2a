"""Definitions of messages, services and actions, read line by line by rosidl's own parser."""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass

from rosidl_adapter.parser import Constant, Field, InvalidValue, is_valid_field_name, parse_message_string

from grader.checks.check import Missed

PARTS = {
    "msg": ("message",),
    "srv": ("request", "response"),
    "action": ("goal", "result", "feedback"),
}
END, MARK = "---", "\ufeff"  # the line that ends a part; what some editors put before a text
MOST, LONGEST = 10_000, 200  # bytes of a definition, characters of a line
# The same as rosidl's own pattern, which takes forever to refuse a long name.
CONSTANT = re.compile(r"[A-Z](?:_?[A-Z0-9])*")
DASHES = "A line with three dashes, and nothing else, not even a space, separates"
TYPES = "Types are bool, string, float64, uint8 and so on, a message of this package, or PACKAGE/Name."


@dataclass(frozen=True)
class InterfacePart:
    """One part of a definition, such as a request: its lines in order, as rosidl understands them.

    fields: such as "float64 mass"; messages of the same package stand without its name, and defaults are left
    out. constants: such as "uint8 FULL=1".
    """

    fields: tuple[str, ...]
    constants: tuple[str, ...]

    def __str__(self) -> str:
        return "\n".join([*self.constants, *self.fields])


def read_definition(path: str, data: bytes, package: str) -> Mapping[str, InterfacePart]:
    """The parts of a definition by their names, in order.

    path: below the package, such as "srv/Find.srv"; the end says of what kind it is, one of `PARTS`.
    Raises Missed where rosidl can't read it.
    """
    expected = f"{path} in a form that rosidl can read"
    names = PARTS[path.rpartition(".")[2]]
    try:
        lines = _lines(data)
        ends = [number for number, line in enumerate(lines) if line == END]
        parts = []
        for begin, end in zip([0, *(end + 1 for end in ends)], [*ends, len(lines)], strict=True):
            parts.append(_part(lines, range(begin, end), package))
        if len(parts) != len(names):
            hint = f"{DASHES} {' and '.join(names)}." if len(names) > 1 else "A message has only one part."
            raise _Unread(f"{len(ends)} lines with ---, and {len(names) - 1} should be there", hint)
    except _Unread as reason:
        raise Missed(expected, *reason.args) from None
    return dict(zip(names, parts, strict=True))


class _Unread(Exception):
    """What was seen, and what to do."""


def _lines(data: bytes) -> list[str]:
    """Without comments; one of dashes as it stands, for there rosidl takes no comment."""
    if len(data) > MOST:
        raise _Unread(f"{len(data)} bytes", f"More than {MOST} bytes are not read: make it shorter.")
    try:
        text = data.decode()
    except UnicodeDecodeError:
        raise _Unread("bytes that aren't text", "Save it as UTF-8.") from None
    if text.startswith(MARK):
        hint = "rosidl reads it as a letter of the first word. Save the file as UTF-8 without BOM."
        raise _Unread("a byte order mark at its beginning", hint)
    lines = [line.replace("\t", " ") for line in text.splitlines()]
    return [line if line.startswith(END) else line.partition("#")[0].rstrip() for line in lines]


def _part(lines: list[str], numbers: range, package: str) -> InterfacePart:
    read = [_read(lines[number], number + 1, package) for number in numbers if lines[number]]
    names = [item.name for item in read]
    for name in names:
        if names.count(name) > 1:
            hint = "Within a part each name may appear only once: remove one of them."
            raise _Unread(f"two lines with the name {name}", hint)
    own = f"{package}/"
    return InterfacePart(
        tuple(f"{item.type} {item.name}".replace(own, "") for item in read if isinstance(item, Field)),
        tuple(f"{item.type} {item.name}={item.value}" for item in read if isinstance(item, Constant)),
    )


def _read(line: str, number: int, package: str) -> Field | Constant:
    hint = _form(line)
    if not hint:
        try:
            with contextlib.redirect_stderr(io.StringIO()):  # it says there what it raises, too
                read = parse_message_string(package, "Any", line)
            return (*read.fields, *read.constants)[0]
        except Exception as error:
            hint = _reason(line, error)
    seen = "".join(letter if letter.isprintable() else "?" for letter in line[:LONGEST])
    raise _Unread(f"line {number}: {seen}", hint)


def _form(line: str) -> str:
    """Return why a line has not even the form of one; "" for one that rosidl may look at."""
    kind, _, rest = line.partition(" ")
    name, *value = re.split(r"[\s=]", rest.strip(), maxsplit=1)
    if len(line) > LONGEST:
        return f"Keep a line to at most {LONGEST} characters before its comment."
    if not line.isprintable():
        return "The ? is an invisible character, such as a web page's special spaces: type the line by hand."
    if line.startswith(" "):
        return "A line begins with its type: delete the spaces before it."
    if line.startswith(END):
        return f"{DASHES} the parts."
    if not name:
        return "Each line has a type, a space, and a name."
    if "=" in rest and is_valid_field_name(name):
        return (
            f"With = it is a constant, whose name is in capital letters. A field is written `{kind} {name}`."
        )
    if "=" in rest and not CONSTANT.fullmatch(name):
        return (
            "Write a constant's name with capital letters, digits and single underscores, such as TOO_HIGH."
        )
    if "=" not in rest and value and CONSTANT.fullmatch(name):
        return f"A constant needs an =, such as `{kind} {name}=1`."
    if "=" not in rest and not is_valid_field_name(name):
        return (
            "Write a field's name with lower-case letters, digits and single underscores, such as top_speed."
        )
    return ""


def _reason(line: str, error: Exception) -> str:
    """Return what to do about a line that rosidl has refused."""
    kind = line.partition(" ")[0]
    long = re.fullmatch(r"(\w+)/(?:msg|srv|action)/(\w+.*)", kind)
    if long:
        return f"In a definition the type has one slash: {long[1]}/{long[2]}."
    if isinstance(error, InvalidValue):
        return f"The text after the name is its value, and rosidl says: {error}."
    return f"`{kind}` is not a type. {TYPES}"
