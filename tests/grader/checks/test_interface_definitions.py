"""Definitions of messages, services and actions, and the words where they can't be read."""

import pytest

from grader.checks import Missed
from grader.checks.interface_definitions import read_definition

DASHES = "A line with three dashes, and nothing else, not even a space, separates"
TYPES = "Types are bool, string, float64, uint8 and so on, a message of this package, or PACKAGE/Name."
TWICE = "Within a part each name may appear only once: remove one of them."
LONG = "Keep a line to at most 200 characters before its comment."
FIELD = "Write a field's name with lower-case letters, digits and single underscores, such as top_speed."
CONSTANT = "Write a constant's name with capital letters, digits and single underscores, such as TOO_HIGH."


def test_each_part_has_its_lines_as_rosidl_understands_them():
    goal, result = b"string name\t\n", b"# nothing\r\n"
    feedback = b"uint8[<=3] codes  # a\nmine/Crate[] all\nuint8 TOO_HIGH = 0x10\n"
    read = read_definition("action/Lift.action", b"---\n".join([goal, result, feedback]), "mine")
    assert {name: (part.fields, part.constants) for name, part in read.items()} == {
        "goal": (("string name",), ()),
        "result": ((), ()),
        "feedback": (("uint8[<=3] codes", "Crate[] all"), ("uint8 TOO_HIGH=16",)),
    }


@pytest.mark.parametrize(
    ("text", "saw", "hint"),
    [
        ("#" * 10_001, "10001 bytes", "More than 10000 bytes are not read: make it shorter."),
        ("\udcff", "bytes that aren't text", "Save it as UTF-8."),
        ("---", "1 lines with ---, and 0 should be there", "A message has only one part."),
        ("--- ", "line 1: --- ", f"{DASHES} the parts."),
        ("---# a", "line 1: ---# a", f"{DASHES} the parts."),
        (
            "\ufeffbool a",
            "a byte order mark at its beginning",
            "rosidl reads it as a letter of the first word. Save the file as UTF-8 without BOM.",
        ),
        (
            "bool\xa0a",
            "line 1: bool?a",
            "The ? is an invisible character, such as a web page's special spaces: type the line by hand.",
        ),
        ("bool a\nbool a", "two lines with the name a", TWICE),
        (f"bool {'a' * 200}", f"line 1: bool {'a' * 195}", LONG),
        ("\n bool a", "line 2:  bool a", "A line begins with its type: delete the spaces before it."),
        ("bool", "line 1: bool", "Each line has a type, a space, and a name."),
        (
            "uint8 state=1",
            "line 1: uint8 state=1",
            "With = it is a constant, whose name is in capital letters. A field is written `uint8 state`.",
        ),
        ("uint8 Full=1", "line 1: uint8 Full=1", CONSTANT),
        (f"uint8 {'A' * 90}_=1", f"line 1: uint8 {'A' * 90}_=1", CONSTANT),
        ("uint8 FULL 1", "line 1: uint8 FULL 1", "A constant needs an =, such as `uint8 FULL=1`."),
        ("bool topSpeed", "line 1: bool topSpeed", FIELD),
        ("bool a;", "line 1: bool a;", FIELD),
        (
            "std_msgs/msg/Header[] a",
            "line 1: std_msgs/msg/Header[] a",
            "In a definition the type has one slash: std_msgs/Header[].",
        ),
        (
            "uint8 A=300",
            "line 1: uint8 A=300",
            "The text after the name is its value, and rosidl says: value '300' can not be converted "
            "to type 'uint8': must be a valid integer value >= 0 and <= 255.",
        ),
        ("float a", "line 1: float a", f"`float` is not a type. {TYPES}"),
        ("x] a", "line 1: x] a", f"`x]` is not a type. {TYPES}"),
    ],
)  # fmt: skip
def test_what_can_not_be_read_is_reported(text, saw, hint, capsys):
    with pytest.raises(Missed) as missed:
        read_definition("msg/A.msg", text.encode(errors="surrogateescape"), "mine")
    assert missed.value.expected == "msg/A.msg in a form that rosidl can read"
    assert (missed.value.saw, missed.value.hint) == (saw, hint)
    assert capsys.readouterr().err == ""


def missed(path, text):
    with pytest.raises(Missed) as caught:
        read_definition(path, text.encode(), "mine")
    assert caught.value.expected == f"{path} in a form that rosidl can read"
    return caught.value.saw, caught.value.hint


@pytest.mark.parametrize(
    ("path", "text", "saw", "parts"),
    [
        ("srv/A.srv", "bool a", "0 lines with ---, and 1 should be there", "request and response"),
        ("srv/A.srv", "---\n---", "2 lines with ---, and 1 should be there", "request and response"),
        ("action/A.action", "---", "1 lines with ---, and 2 should be there", "goal and result and feedback"),
    ],
)
def test_a_service_has_two_parts_and_an_action_three(path, text, saw, parts):
    assert missed(path, text) == (saw, f"{DASHES} {parts}.")


def test_a_definition_of_10000_bytes_and_a_line_of_200_characters_are_read():
    line = f"bool {'a' * 195}"
    text = f"{line}\n#{'-' * (10_000 - len(line) - 2)}"
    (part,) = read_definition("msg/A.msg", text.encode(), "mine").values()
    assert part.fields == (line,)
    assert missed("msg/A.msg", f"{text}-")[0] == "10001 bytes"
    assert missed("msg/A.msg", f"{line}a")[1] == LONG


def test_a_part_is_shown_with_its_constants_first():
    (part,) = read_definition("msg/A.msg", b"bool a\nuint8 B=1\nbool c\nuint8 D = 2", "mine").values()
    assert str(part) == "uint8 B=1\nuint8 D=2\nbool a\nbool c"


def test_the_line_that_can_not_be_read_is_named_in_every_part():
    assert missed("srv/A.srv", "bool a\n\n---\nbool b\nbool Ups")[0] == "line 5: bool Ups"


def test_names_may_come_again_in_another_part():
    found = read_definition("srv/A.srv", b"bool a\n---\nbool a", "mine")
    assert [part.fields for part in found.values()] == [("bool a",), ("bool a",)]


def test_a_default_is_left_out_and_a_string_may_have_spaces_and_signs():
    found = read_definition("msg/A.msg", b"string a 'b c'\nstring D = 'e f'", "mine")
    assert str(found["message"]) == "string D=e f\nstring a"
