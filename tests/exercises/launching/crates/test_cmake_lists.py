"""What is read of a CMakeLists.txt, and the words where it can't be read."""

import pytest

from grader.checks import Missed
from grader.exercises.launching.crates.cmake_lists import CMakeCommand, read_commands


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
        ('\na("b', "'\"b' in line 2", "Something begins there and never ends: close the quote or bracket."),
        ("\na b", "b in line 2", "A command such as project(...) should begin there."),
        (")", ") in line 1", "A command such as project(...) should begin there."),
        ("a(b", "a without )", "Close the command with its parenthesis."),
        ("a", "a without (...)", "Close the command with its parenthesis."),
    ],
)
def test_what_cmake_can_not_read_is_reported(text, saw, hint):
    with pytest.raises(Missed) as missed:
        read_commands(text.encode())
    assert missed.value.expected == "a CMakeLists.txt that can be read"
    assert (missed.value.saw, missed.value.hint) == (saw, hint)


def words(text):
    (command,) = read_commands(text)
    return command.words


def missed(text):
    with pytest.raises(Missed) as caught:
        read_commands(text)
    return caught.value.saw


def test_a_file_of_20000_bytes_and_a_command_of_5000_characters_are_read():
    assert read_commands(b"#" * 20_000) == []
    assert words(b"a(%b)" % (b"b" * 5000)) == ("b" * 5000,)
    assert missed(b"a(%b)" % (b"b" * 5001)) == "a command with 5001 characters"


def test_what_is_no_utf8_is_read_with_a_sign_in_its_place():
    assert words(b"a(\xff)") == ("\ufffd",)


def test_brackets_in_quotes_are_words_and_other_ones_are_left_out():
    assert words(b'a("(" b (c (d)) ")")') == ("(", "b", "c", "d", ")")
    assert missed(b"(a)") == "( in line 1"


def test_no_more_than_the_beginning_of_a_long_word_is_shown():
    assert missed(b"a " + b"b" * 50) == f"{'b' * 40} in line 1"
    assert missed(b"a" * 50) == f"{'a' * 40} without (...)"
    assert missed(b'a("' + b"b" * 50) == f"'\"{'b' * 19}' in line 1"


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        *(("TRUE", True), ("1", True), ("on", True), ("FALSE", False), ("0", False), ("OFF", False)),
        *(("NOT FALSE", True), ("NOT TRUE", False), ("yes", True), ("no", False), ("none", True)),
        *(("TRUE AND FALSE", False), ("TRUE AND NOT FALSE", True), ("FALSE OR TRUE AND TRUE", True)),
        *(("BUILD_TESTING", False), ("a STREQUAL a", False), ("NOT a STREQUAL b", False), ("", False)),
        *(("${none}", False), ("${yes}", True), (" OR ".join(["FALSE"] * 500), False)),
    ],
)
def test_commands_in_a_condition_count_if_it_holds(condition, holds):
    text = f"set(yes ON)\nset(no OFF)\nset(none b)\nif({condition})\na()\nelse()\nb()\nendif()"
    assert [command.name for command in read_commands(text.encode())][3:] == ["a" if holds else "b"]


def test_the_first_branch_that_holds_counts_and_what_is_in_it():
    text = b"if(0)\na()\nelseif(1)\nif(0)\nb()\nendif()\nc()\nelseif(1)\nd()\nelse()\ne()\nendif()\nf()"
    assert [command.name for command in read_commands(text)] == ["c", "f"]


@pytest.mark.parametrize("block", ["foreach", "while", "function", "macro"])
def test_what_is_in_a_loop_or_a_function_does_not_count(block):
    assert [command.name for command in read_commands(f"{block}(a)\nb()\nend{block}()\nc()".encode())] == ["c"]


def test_what_is_in_a_block_counts():
    assert [command.name for command in read_commands(b"block()\na()\nendblock()\nendif()")] == ["a", "endif"]


@pytest.mark.parametrize("end", ["return()", "message(FATAL_ERROR a)"])
def test_nothing_counts_after_the_end(end):
    assert [command.name for command in read_commands(f"a()\nmessage(b)\n{end}\nc()".encode())] == [
        "a", "message",
    ]
