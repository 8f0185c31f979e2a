"""What is read of a package of interfaces, and the words where it can't be read."""

import subprocess
import sys
from pathlib import Path

import pytest

from grader.checks import Missed
from grader.checks.cmake_lists import CMakeCommand, read_commands
from grader.checks.interface_definitions import read_definition
from grader.exercises import packages
from tests.students.packages import crates
from tests.students.workspaces import Workspace

TARGET = "crate_interfaces__rosidl_generator_type_description"  # what comes first, before any compiler
DASHES = "A line with three dashes, and nothing else, not even a space, stands between"
TYPES = "Types are bool, string, float64, uint8 and so on, a message of this package, or PACKAGE/Name."
TWICE = "Within a part each name stands once: leave one of them out."
LONG = "A line has at most 200 characters before its comment."
FIELD = "The name of a field has small letters, digits and single underscores, such as top_speed."
CONSTANT = "The name of a constant has capital letters, digits and single underscores, such as TOO_HIGH."


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
        ("\udcff", "bytes that are no text", "Save it as UTF-8."),
        ("---", "1 lines with ---, and 0 should be there", "A message has one part only."),
        ("--- ", "line 1: --- ", f"{DASHES} the parts."),
        ("---# a", "line 1: ---# a", f"{DASHES} the parts."),
        (
            "\ufeffbool a",
            "a byte order mark at its beginning",
            "rosidl takes it for a letter of the first word. Save it as UTF-8 without BOM.",
        ),
        (
            "bool\xa0a",
            "line 1: bool?a",
            "The ? is a letter that doesn't show, such as a page's own spaces: type the line by hand.",
        ),
        ("bool a\nbool a", "two lines with the name a", TWICE),
        (f"bool {'a' * 200}", f"line 1: bool {'a' * 195}", LONG),
        ("\n bool a", "line 2:  bool a", "A line begins with its type: delete the spaces before it."),
        ("bool", "line 1: bool", "Each line has a type, a space, and a name."),
        (
            "uint8 state=1",
            "line 1: uint8 state=1",
            "With = it is a constant, whose name has capital letters. A field reads `uint8 state`.",
        ),
        ("uint8 Full=1", "line 1: uint8 Full=1", CONSTANT),
        (f"uint8 {'A' * 90}_=1", f"line 1: uint8 {'A' * 90}_=1", CONSTANT),
        ("uint8 FULL 1", "line 1: uint8 FULL 1", "A constant has a =, such as `uint8 FULL=1`."),
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
            "What stands behind the name is its value, and rosidl says: value '300' can not be converted "
            "to type 'uint8': must be a valid integer value >= 0 and <= 255.",
        ),
        ("float a", "line 1: float a", f"`float` is no type. {TYPES}"),
        ("x] a", "line 1: x] a", f"`x]` is no type. {TYPES}"),
    ],
)  # fmt: skip
def test_what_can_not_be_read_is_told(text, saw, hint, capsys):
    with pytest.raises(Missed) as missed:
        read_definition("msg/A.msg", text.encode(errors="surrogateescape"), "mine")
    assert missed.value.expected == "msg/A.msg in a form that rosidl can read"
    assert (missed.value.saw, missed.value.hint) == (saw, hint)
    assert capsys.readouterr().err == ""


def test_brackets_with_signs_a_mark_of_an_editor_and_windows_ends_of_lines_are_read():
    text = '\ufeff#[=[ a\r\n]] ) ]=]\r\nset(a [==[b]=] c]==]\r\n  "d")\r\n#[\r\n# ["\r\n'
    assert read_commands(text.encode()) == [CMakeCommand("set", ("a", "b]=] c", "d"))]


def test_commands_have_their_words_with_variables_put_in():
    text = b'PROJECT(a)\nset(b c "d e")  # f\nlist(APPEND b g)\nh(${PROJECT_NAME} "${b}" (i) [[j k]] ${l})'
    assert read_commands(text) == [
        CMakeCommand("project", ("a",)),
        CMakeCommand("set", ("b", "c", "d e")),
        CMakeCommand("list", ("APPEND", "b", "g")),
        CMakeCommand("h", ("a", "c", "d e", "g", "i", "j k")),
    ]


@pytest.mark.parametrize(
    ("text", "saw", "hint"),
    [
        ("#" * 20_001, "20001 bytes", "More than 20000 bytes are not read: make it shorter."),
        (
            "set(a 0123456789)\n" + "set(a ${a} ${a})\n" * 100,
            "a command with 5631 characters",
            "More than 5000 are not read.",
        ),
        ('\na("b', "'\"b' in line 2", "What begins there has no end."),
        ("\na b", "b in line 2", "There a command should begin, such as project(...)."),
        (")", ") in line 1", "There a command should begin, such as project(...)."),
        ("a(b", "a without )", "A command ends with its bracket."),
        ("a", "a without (...)", "A command ends with its bracket."),
    ],
)
def test_what_cmake_can_not_read_is_told(text, saw, hint):
    with pytest.raises(Missed) as missed:
        read_commands(text.encode())
    assert missed.value.expected == "a CMakeLists.txt that can be read"
    assert (missed.value.saw, missed.value.hint) == (saw, hint)


def test_a_look_prints_the_definitions_as_they_are_read(capsys):
    definitions = crates.changed(crates.RIGHT, crates.LIFT, "bool lifted", "bool Lifted")
    assert packages.see(packages.crates, Workspace(__name__, definitions)).seconds == 0
    assert capsys.readouterr().out == f"""\
crate_interfaces/action/Lift
    line 4: bool Lifted
    Hint: {FIELD}
crate_interfaces/msg/Crate
    uint8 EMPTY=0
    uint8 FULL=1
    string label
    float64 mass
    uint8 state
    geometry_msgs/Point place
crate_interfaces/srv/FindCrates
    float64 heaviest
    ---
    Crate[] crates
"""


@pytest.mark.soak  # each takes 11 s of computing
@pytest.mark.parametrize(
    ("name", "status"),
    [
        *((name, 0) for name in ("Crates", "ListsOfFiles", "WrittenOtherwise")),
        *((name, 0) for name in ("SavedOnWindows", "MarkedByAnEditor", "SpacesAndTabs")),
        *((name, 1) for name in ("MarkedDefinition", "SpaceOfAPage", "CommentAfterDashes")),
        *((name, 1) for name in ("SmallLetters", "TwoSlashes", "NoGroup", "OtherProject")),
        *((name, 1) for name in ("FindsNoGenerators", "FindsNoGeometry", "NoVersion")),
        *((name, 1) for name in ("OneTooMany", "OpenBracket")),
        ("NoDependencies", 2),
    ],
)
def test_the_real_tools_say_the_same(name, status):
    workspace, colcon = getattr(crates, name), Path(sys.executable).with_name("colcon")
    words = "--log-base", "/dev/null", "build", "--cmake-target", TARGET
    done = subprocess.run([colcon, *words], cwd=workspace.__fspath__(), capture_output=True, check=False)
    assert done.returncode == status, done.stderr
